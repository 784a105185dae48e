#include "tools/glb/contact_extras.h"

#include <fmt/format.h>

#include "tools/contact_json.h"
#include "tools/json_text.h"

namespace foretouch::tools {
namespace {

const std::string& objectOf(const LinkContact& contact, const Scene& scene) {
  return scene.objectNames()[static_cast<std::size_t>(scene.object(contact.triangle))];
}

}  // namespace

double timeOf(const LinkContact& contact, const StepAnswer& answer) {
  return answer.t0S + contact.toi * (answer.t1S - answer.t0S);
}

std::string contactTitle(const LinkContact& contact, double timeS, const Skeleton& skeleton,
                         const Scene& scene) {
  return fmt::format("{} at {}, {:.3f} s", skeleton.name(contact.link), objectOf(contact, scene),
                     timeS);
}

nlohmann::json contactExtras(const LinkContact& contact, std::int64_t step, double timeS,
                             bool isMissedByPoses, const Skeleton& skeleton, const Scene& scene) {
  const std::string link = jsonString(skeleton.name(contact.link));
  const std::string object = jsonString(objectOf(contact, scene));
  const std::string instant = R"("time":)" + numberText(timeS);
  ContactWords words;
  words.link = link;
  words.object = object;
  words.instant = instant;
  std::string text;
  appendContact(contact, words, text);
  nlohmann::json extras = nlohmann::json::parse(text);
  extras["step"] = step;
  extras["missed_by_poses"] = isMissedByPoses;
  return extras;
}

}  // namespace foretouch::tools
