// assets/import/xml_document.h: a stranger's XML text, parsed by TinyXML, or the place of what is
// wrong with it. In foretouch-import only. Not installed.
#pragma once

#include <string>
#include <tinyxml.h>

namespace foretouch::internal {

/// Throws Failure (assets/import/failure.h) with the line if `text` is not well-formed.
void parseXml(const std::string& text, TiXmlDocument& document);

/// "" if the element has no such attribute.
[[nodiscard]] std::string attributeOf(const TiXmlElement& element, const char* name);

/// The element of that name at the top; throws Failure with the line if there is none.
[[nodiscard]] const TiXmlElement& rootOf(const TiXmlDocument& document, const char* name);

}  // namespace foretouch::internal
