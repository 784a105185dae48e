#include "tools/contact_json.h"

#include <cmath>
#include <type_traits>
#include <variant>

#include "middleware/contact.h"
#include "middleware/exact/feature.h"

namespace foretouch::tools {
namespace {

template <typename Value>
void writeValue(const Value& value, JsonWriter& out) {
  if constexpr (std::is_enum_v<Value>) {
    out.value(toString(value));
  } else {
    out.value(value);
  }
}

}  // namespace

void writeContact(const LinkContact& contact, const ContactWords& words, JsonWriter& out) {
  const bool isOwn = !words.other.empty();
  for (const ContactField& field : kContactFields) {
    if (!isTold(field.use, contact)) continue;
    const std::string_view name = field.name;
    if (isOwn && (name == "object" || (name == "triangle" && contact.triangle < 0))) continue;
    if (name == "penetration") {
      writePenetration(contact.penetration, out);
      if (std::isfinite(words.penetrationAtMost)) {
        out.field("penetration_at_most", words.penetrationAtMost);
      }
      continue;
    }
    out.key(name);
    if (name == "link") {
      out.raw(words.link);
    } else if (name == "object") {
      out.raw(words.object);
    } else {
      std::visit([&](auto member) { writeValue(contact.*member, out); }, field.member);
    }
    if (isOwn && name == "link") out.rawField("other", words.other);
    if (name != "toi") continue;
    if (words.timeS) out.field("time", *words.timeS);
    if (words.utimeUs) out.field("utime", *words.utimeUs);
  }
}

}  // namespace foretouch::tools
