#include "tools/contact_json.h"

#include <fmt/format.h>

#include "middleware/exact/feature.h"
#include "tools/json_text.h"

namespace foretouch::tools {
namespace {

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("[{},{},{}]", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

}  // namespace

void appendContact(const LinkContact& contact, const ContactWords& words, std::string& text) {
  text += fmt::format(R"({{"link":{},"verdict":"{}")", words.link, toString(contact.verdict));
  if (contact.verdict == Verdict::Undecided) {
    text += fmt::format(R"(,"free_until":{},"reason":"{}"}})", numberText(contact.freeUntil),
                        words.reason);
    return;
  }
  text += fmt::format(R"(,"toi":{},{},"separation":{})", numberText(contact.toi), words.instant,
                      numberText(contact.separation));
  if (contact.verdict == Verdict::StartsInContact) {
    text += fmt::format(R"(,"penetration":{})", numberText(contact.penetration));
  }
  text += fmt::format(R"(,"point":{},"on_link":{},"normal":{},"triangle":{},"object":{})",
                      numbers(contact.p_WScene), numbers(contact.p_WLink),
                      numbers(contact.nhat_SL_W), contact.triangle, words.object);
  if (contact.linkTriangle >= 0) {
    text += fmt::format(R"(,"link_triangle":{},"link_feature":"{}","scene_feature":"{}")",
                        contact.linkTriangle, toString(contact.linkFeature),
                        toString(contact.sceneFeature));
  }
  text += '}';
}

}  // namespace foretouch::tools
