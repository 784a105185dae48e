#include "assets/import/urdf_text.h"

#include <memory>
#include <tinyxml.h>

#include "assets/import/assimp.h"
#include "assets/import/text.h"
#include "assets/import/xml_damage.h"

namespace foretouch::internal {
namespace {

std::string attributeOf(const TiXmlElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

/// The element without its children, with the name `name`.
std::unique_ptr<TiXmlElement> bare(const TiXmlElement& from, const char* name) {
  auto copy = std::make_unique<TiXmlElement>(name);
  for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
    copy->SetAttribute(a->Name(), a->Value());
  }
  return copy;
}

/// Copies the first child of that name, if there is one; returns the copy.
TiXmlElement* keep(const TiXmlElement& from, const char* name, TiXmlElement& to) {
  const TiXmlElement* child = from.FirstChildElement(name);
  return child == nullptr ? nullptr : to.LinkEndChild(bare(*child, name).release())->ToElement();
}

class Reducer {
 public:
  explicit Reducer(UrdfText& out) : out_(out) {}

  void addLink(const TiXmlElement& link, TiXmlElement& robot) {
    TiXmlElement& copy = *robot.LinkEndChild(bare(link, "link").release())->ToElement();
    addShapes(link, "collision", UrdfShapeKind::Collision, copy);
    addShapes(link, "visual", UrdfShapeKind::Visual, copy);
  }

  void addJoint(const TiXmlElement& joint, TiXmlElement& robot) {
    TiXmlElement& copy = *robot.LinkEndChild(bare(joint, "joint").release())->ToElement();
    for (const char* name : {"origin", "parent", "child", "axis"}) keep(joint, name, copy);
    if (TiXmlElement* mimic = keep(joint, "mimic", copy)) {
      out_.notes.push_back("joint '" + readableText(attributeOf(joint, "name"), 80) + "' mimics '" +
                           readableText(attributeOf(*mimic, "joint"), 80) +
                           "': a pose may move it by itself");
    }
    addLimit(joint, copy);
  }

 private:
  void addLimit(const TiXmlElement& joint, TiXmlElement& copy) {
    TiXmlElement* limit = keep(joint, "limit", copy);
    const std::string type = attributeOf(joint, "type");
    if (limit == nullptr && (type == "revolute" || type == "prismatic")) {
      out_.notes.push_back("joint '" + readableText(attributeOf(joint, "name"), 80) +
                           "' states no limits");
      limit = copy.LinkEndChild(new TiXmlElement("limit"))->ToElement();
    }
    if (limit == nullptr) return;
    for (const char* name : {"effort", "velocity"}) limit->SetAttribute(name, "0");
  }

  void addShapes(const TiXmlElement& link, const char* name, UrdfShapeKind kind,
                 TiXmlElement& copy) {
    std::size_t index = 0;
    for (const auto* shape = link.FirstChildElement(name); shape != nullptr;
         shape = shape->NextSiblingElement(name), ++index) {
      TiXmlElement& kept = *copy.LinkEndChild(bare(*shape, name).release())->ToElement();
      keep(*shape, "origin", kept);
      const TiXmlElement* geometry = shape->FirstChildElement("geometry");
      const TiXmlElement* solid = geometry == nullptr ? nullptr : geometry->FirstChildElement();
      if (solid == nullptr) continue;  // for urdfdom to refuse
      const bool isCapsule = solid->ValueStr() == "capsule";
      if (isCapsule) out_.capsules.emplace(attributeOf(link, "name"), kind, index);
      kept.LinkEndChild(new TiXmlElement("geometry"))
          ->LinkEndChild(bare(*solid, isCapsule ? "cylinder" : solid->Value()).release());
    }
  }

  UrdfText& out_;
};

/// TinyXML reports an unclosed element without a line.
std::string whyMalformed(const std::string& text, const TiXmlDocument& document) {
  const std::string damage = damageOfXml(text);
  if (!damage.empty()) return damage;
  const std::string line = std::to_string(document.ErrorRow());
  return (document.ErrorRow() > 0 ? "line " + line + ": " : "") + document.ErrorDesc();
}

std::string withoutRobot(const TiXmlDocument& document) {
  const TiXmlElement* root = document.RootElement();
  if (root == nullptr) return "expected a <robot> element, found none";
  return "line " + std::to_string(root->Row()) + ": expected a <robot> element, found <" +
         readableText(root->ValueStr(), 80) + ">";
}

}  // namespace

UrdfText readUrdfText(const std::string& text) {
  if (text.find('\0') != std::string::npos) {
    const std::string damage = damageOfXml(text);
    throw Failure{ImportFailure::Refused,
                  damage.empty() ? "not a text: it holds a zero byte" : damage};
  }
  TiXmlDocument document;
  document.Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  if (document.Error()) throw Failure{ImportFailure::Refused, whyMalformed(text, document)};
  const TiXmlElement* from = document.FirstChildElement("robot");
  if (from == nullptr) throw Failure{ImportFailure::Refused, withoutRobot(document)};
  TiXmlElement robot("robot");
  robot.SetAttribute("name", "robot");  // urdfdom refuses robots without a name, which exist
  UrdfText out;
  Reducer reducer(out);
  for (const auto* e = from->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (e->ValueStr() == "link") reducer.addLink(*e, robot);
    if (e->ValueStr() == "joint") reducer.addJoint(*e, robot);
  }
  TiXmlPrinter printer;
  robot.Accept(&printer);
  out.xml = printer.Str();
  return out;
}

}  // namespace foretouch::internal
