// tools/contact_json.h: one contact as JSON (docs/formats.md, "Results"): the same fields in a
// results file, in the lines of a stream, in view documents, in live events and in a GLB.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "assets/json_writer.h"
#include "middleware/contact.h"

namespace foretouch::tools {

/// Fields that the contact itself lacks; JSON already.
struct ContactWords {
  std::string_view link;        ///< Its name, or its number.
  std::string_view object;      ///< Not read if the link is undecided, nor are the next fields.
  std::optional<double> timeS;  ///< Time of contact: in the clip,
  std::optional<std::int64_t> utimeUs;  ///< and on the clock.
  /// The own link, its name or number, that takes the place of the scene; empty: none.
  std::string_view other;
  /// How deep an own link that starts in contact is at most (m); infinite: not known.
  double penetrationAtMost = std::numeric_limits<double>::infinity();
};

/// Writes the contact's fields by kContactFields into an open object. `contact` is not clear.
void writeContact(const LinkContact& contact, const ContactWords& words, JsonWriter& out);

/// How deep a start in contact is (m); null if that is not known, as for triangles, which have no
/// inside.
inline void writePenetration(double penetration, JsonWriter& out) {
  out.key("penetration");
  penetration > 0.0 ? out.value(penetration) : out.null();
}

}  // namespace foretouch::tools
