#include "tools/glb/contact_extras.h"

#include <fmt/format.h>

#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/contact_json.h"

namespace foretouch::tools {
namespace {

const std::string& objectOf(const LinkContact& contact, const Scene& scene) {
  return scene.objectNames()[slotOf(scene.object(contact.triangle))];
}

}  // namespace

std::string contactTitle(const ReportedContact& shown, const Skeleton& skeleton,
                         const Scene& scene) {
  return fmt::format("{} at {}, {:.3f} s", skeleton.name(shown.contact.link),
                     objectOf(shown.contact, scene), shown.timeS);
}

nlohmann::json contactExtras(const ReportedContact& shown, const Skeleton& skeleton,
                             const Scene& scene) {
  const std::string link = jsonString(skeleton.name(shown.contact.link));
  const std::string object = jsonString(objectOf(shown.contact, scene));
  ContactWords words;
  words.link = link;
  words.object = object;
  words.timeS = shown.timeS;
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  writeContact(shown.contact, words, out);
  out.field("step", shown.step);
  out.field("missed_by_poses", shown.missedByPoses);
  out.endObject();
  return nlohmann::json::parse(text);
}

}  // namespace foretouch::tools
