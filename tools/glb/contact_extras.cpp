#include "tools/glb/contact_extras.h"

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/contact_json.h"
#include "tools/json_line.h"
#include "tools/touches/touch_json.h"

namespace foretouch::tools {
namespace {

const std::string& objectOf(const LinkContact& contact, const Scene& scene) {
  return scene.objectNames()[slotOf(scene.object(contact.triangle))];
}

}  // namespace

std::string contactTitle(const ShownTouch& shown, const Skeleton& skeleton, const Scene& scene) {
  const ReportedContact& first = shown.first;
  return fmt::format("{} at {}, {:.3f} s", skeleton.name(first.contact.link),
                     objectOf(first.contact, scene), first.timeS);
}

nlohmann::json contactExtras(const ShownTouch& shown, const Skeleton& skeleton,
                             const Scene& scene) {
  const ReportedContact& first = shown.first;
  const std::string link = jsonString(skeleton.name(first.contact.link));
  const std::string object = jsonString(objectOf(first.contact, scene));
  ContactWords words;
  words.link = link;
  words.object = object;
  words.timeS = first.timeS;
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeContact(first.contact, words, out);
  out.field("step", first.step);
  if (shown.push) {
    out.field("push", *shown.push);
  } else {
    out.field("missed_by_poses", first.missedByPoses);
  }
  TouchWords ofTouch;
  ofTouch.link = link;
  ofTouch.object = object;
  writeObject("touch", out, [&] { writeTouch(shown.touch, ofTouch, out); });
  out.endObject();
  return nlohmann::json::parse(text);
}

}  // namespace foretouch::tools
