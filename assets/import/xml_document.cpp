#include "assets/import/xml_document.h"

#include "assets/import/failure.h"
#include "assets/import/text.h"
#include "assets/import/xml_damage.h"

namespace foretouch::internal {
namespace {

/// TinyXML reports an unclosed element without a line.
std::string whyMalformed(const std::string& text, const TiXmlDocument& document) {
  const std::string damage = damageOfXml(text);
  if (!damage.empty()) return damage;
  const std::string line = std::to_string(document.ErrorRow());
  return (document.ErrorRow() > 0 ? "line " + line + ": " : "") + document.ErrorDesc();
}

}  // namespace

void parseXml(const std::string& text, TiXmlDocument& document) {
  if (text.find('\0') != std::string::npos) {
    const std::string damage = damageOfXml(text);
    throw Failure{ImportFailure::Refused,
                  damage.empty() ? "not a text: it holds a zero byte" : damage};
  }
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  if (document.Error()) throw Failure{ImportFailure::Refused, whyMalformed(text, document)};
}

std::string attributeOf(const TiXmlElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

const TiXmlElement& rootOf(const TiXmlDocument& document, const char* name) {
  if (const TiXmlElement* found = document.FirstChildElement(name)) return *found;
  const std::string expected = "expected a <" + std::string(name) + "> element, found ";
  const TiXmlElement* root = document.RootElement();
  if (root == nullptr) throw Failure{ImportFailure::Refused, expected + "none"};
  throw Failure{ImportFailure::Refused, "line " + std::to_string(root->Row()) + ": " + expected +
                                            "<" + readableText(root->ValueStr(), 80) + ">"};
}

}  // namespace foretouch::internal
