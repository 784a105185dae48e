#include "tools/results_writer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lss/assert.h"
#include "middleware/exact/feature.h"

namespace foretouch::tools {
namespace {

/// The shortest text that reads back as the same double.
std::string number(double value) {
  FORETOUCH_ASSERT(std::isfinite(value));
  return fmt::format("{}", value);
}

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("[{},{},{}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string list(const std::vector<std::string>& texts) {
  std::string out = "[";
  for (const std::string& text : texts) out += (out.size() > 1 ? "," : "") + jsonString(text);
  return out + "]";
}

std::string fileName(const std::string& path) {
  return jsonString(std::filesystem::path(path).filename().string());
}

}  // namespace

std::vector<LinkContact> notClear(const std::vector<LinkContact>& links) {
  std::vector<LinkContact> contacts;
  std::copy_if(links.begin(), links.end(), std::back_inserter(contacts),
               [](const LinkContact& c) { return c.verdict != Verdict::Clear; });
  std::sort(contacts.begin(), contacts.end(), isReportedBefore);
  return contacts;
}

std::string jsonString(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

/// What only exact and skinned fidelity depend on.
std::string surfaceFields(const ReplayRequest& request) {
  if (request.fidelity == Fidelity::Exact) {
    return fmt::format(R"(,"leaves":"{}")", toString(request.leafMethod));
  }
  if (request.fidelity == Fidelity::Skinned) {
    return fmt::format(R"(,"skin":{},"skin_scale":{},"skin_up":"{}")", fileName(request.skinPath),
                       number(request.skinScale), request.skinUp == UpAxis::Z ? "z" : "y");
  }
  return "";
}

/// What only motions that are no BVH clips depend on.
std::string motionFields(const ReplayRequest& request) {
  std::string text;
  if (!request.animation.empty()) {
    text += fmt::format(R"(,"animation":{})", jsonString(request.animation));
  }
  if (!request.robotPath.empty()) {
    text += fmt::format(R"(,"robot":{})", fileName(request.robotPath));
  }
  return text;
}

}  // namespace

std::string headerLine(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::vector<std::string> links;
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    links.push_back(inputs.avatar.skeleton().name(link));
  }
  const Eigen::Vector3d& origin = request.placement.origin;
  std::string text = R"({"format":"foretouch-results","version":1)";
  text += fmt::format(R"(,"tool":"{}","scene":{},"avatar":{},"motion":{})", FORETOUCH_VERSION,
                      fileName(request.scenePath), fileName(request.avatarPath),
                      fileName(request.motionPath));
  text += fmt::format(R"(,"rate":{},"k":{},"frame_time":{},"steps":{})",
                      request.rateHz ? number(*request.rateHz) : "null", inputs.steps.stride,
                      number(inputs.clip.frameTimeS), inputs.steps.count);
  text += fmt::format(R"(,"tolerance":{},"fidelity":"{}")", number(request.tolerance),
                      toString(request.fidelity));
  text += fmt::format(R"(,"scale":{},"motion_up":"{}","place":[{},{},{},{}])",
                      number(request.motionScale), request.placement.motionUpZ ? "z" : "y",
                      number(origin.x()), number(origin.y()), number(origin.z()),
                      number(request.placement.yawDeg));
  text += fmt::format(R"(,"scene_scale":{},"up":"{}","ignore":{})", number(request.sceneScale),
                      request.sceneUp == UpAxis::Z ? "z" : "y", list(request.ignore));
  if (request.scope != Scope::EveryLink) {
    text += fmt::format(R"(,"scope":"{}")", toString(request.scope));
  }
  text += surfaceFields(request) + motionFields(request);
  text += fmt::format(R"(,"links":{},"unmatched_joints":{})", list(links),
                      list(inputs.match.unmatchedAvatar));
  return text + "}\n";
}

StepFormat::StepFormat(const Avatar& avatar, const Scene& scene) : scene_(scene) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    links_.push_back(jsonString(avatar.skeleton().name(link)));
  }
  for (const std::string& name : scene.objectNames()) objects_.push_back(jsonString(name));
}

std::string StepFormat::line(const StepAnswer& answer) const {
  std::string text = fmt::format(R"({{"step":{},"t0":{},"t1":{},"contacts":[)", answer.step,
                                 number(answer.t0S), number(answer.t1S));
  for (std::size_t i = 0; i < answer.contacts.size(); ++i) {
    if (i > 0) text += ',';
    append(answer.contacts[i], answer, text);
  }
  return text + fmt::format("],\"latency_us\":{:.1f}}}\n", answer.latencyUs);
}

void StepFormat::append(const LinkContact& contact, const StepAnswer& answer,
                        std::string& text) const {
  text += fmt::format(R"({{"link":{},"verdict":"{}")",
                      links_[static_cast<std::size_t>(contact.link)], toString(contact.verdict));
  if (contact.verdict == Verdict::Undecided) {
    text += fmt::format(R"(,"free_until":{},"reason":"{}"}})", number(contact.freeUntil),
                        toString(contact.reason));
    return;
  }
  const auto object = static_cast<std::size_t>(scene_.object(contact.triangle));
  text += fmt::format(R"(,"toi":{},"time":{},"separation":{})", number(contact.toi),
                      number(answer.t0S + contact.toi * (answer.t1S - answer.t0S)),
                      number(contact.separation));
  if (contact.verdict == Verdict::StartsInContact) {
    text += fmt::format(R"(,"penetration":{})", number(contact.penetration));
  }
  text += fmt::format(R"(,"point":{},"on_link":{},"normal":{},"triangle":{},"object":{})",
                      numbers(contact.p_WScene), numbers(contact.p_WLink),
                      numbers(contact.nhat_SL_W), contact.triangle, objects_[object]);
  if (contact.linkTriangle >= 0) {
    text += fmt::format(R"(,"link_triangle":{},"link_feature":"{}","scene_feature":"{}")",
                        contact.linkTriangle, toString(contact.linkFeature),
                        toString(contact.sceneFeature));
  }
  text += '}';
}

}  // namespace foretouch::tools
