// tools/contact_json.h: one contact as JSON (docs/formats.md, "Results"): the same text in a
// results file and in the lines of a stream.
#pragma once

#include <string>
#include <string_view>

#include "middleware/query/query.h"

namespace foretouch::tools {

/// What a contact says in words; `link` and `object` are JSON strings already.
struct ContactWords {
  std::string_view link;
  std::string_view object;  ///< Not read where the link is undecided.
  std::string_view reason;  ///< Read only where it is.
  std::string_view
      instant;  ///< When it is touched, as a field: "time":0.34. Not read there either.
};

/// The object's text, without a line break. `contact` is not clear.
void appendContact(const LinkContact& contact, const ContactWords& words, std::string& text);

}  // namespace foretouch::tools
