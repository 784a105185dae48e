// assets/import/xml_damage.h: finds XML that is not well formed: tags that do not match, attributes
// without quotes, a text that ends too early. Source: W3C, "Extensible Markup Language (XML) 1.0",
// sections 2 and 3, less entities and document types. In foretouch-import only. Not installed.
#pragma once

#include <string>
#include <string_view>

namespace foretouch::internal {

/// "line 12: expected </node>, which closes line 8, found </mesh>"; empty if it finds nothing, and
/// for a text that is not in UTF-8 or ASCII.
[[nodiscard]] std::string damageOfXml(std::string_view text);

}  // namespace foretouch::internal
