#include "tools/replay/results_writer.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "tools/contact_json.h"
#include "tools/json_text.h"

namespace foretouch::tools {
std::vector<LinkContact> notClear(const std::vector<LinkContact>& links) {
  std::vector<LinkContact> contacts;
  std::copy_if(links.begin(), links.end(), std::back_inserter(contacts),
               [](const LinkContact& c) { return c.verdict != Verdict::Clear; });
  std::sort(contacts.begin(), contacts.end(), isReportedBefore);
  return contacts;
}

namespace {

/// Each rule as it was given.
std::string policiesJson(const std::vector<PolicyRule>& rules) {
  std::string text = "[";
  for (const PolicyRule& rule : rules) {
    std::string fields;
    if (!rule.links.empty()) fields += ",\"links\":" + jsonList(rule.links);
    if (!rule.objects.empty()) fields += ",\"objects\":" + jsonList(rule.objects);
    if (rule.tolerance) fields += ",\"tolerance\":" + numberText(*rule.tolerance);
    if (rule.fidelity) fields += std::string(",\"fidelity\":\"") + toString(*rule.fidelity) + '"';
    if (rule.ignore) fields += *rule.ignore ? ",\"ignore\":true" : ",\"ignore\":false";
    if (text.size() > 1) text += ',';
    text += '{' + fields.substr(1) + '}';
  }
  return text + ']';
}

/// What only motions that are no BVH clips depend on.
std::string motionFields(const ReplayRequest& request) {
  std::string text;
  if (!request.animation.empty()) {
    text += fmt::format(R"(,"animation":{})", jsonString(request.animation));
  }
  if (!request.robotPath.empty()) {
    text += fmt::format(R"(,"robot":{})", jsonFileName(request.robotPath));
  }
  return text;
}

}  // namespace

std::string policyField(const ReplayRequest& request) {
  return request.policies.empty() ? "" : ",\"policy\":" + policiesJson(request.policies);
}

std::string surfaceFields(const ReplayRequest& request) {
  const bool isExact =
      request.fidelity == Fidelity::Exact ||
      std::any_of(request.policies.begin(), request.policies.end(),
                  [](const PolicyRule& r) { return r.fidelity == Fidelity::Exact; });
  if (isExact) {
    return fmt::format(R"(,"leaves":"{}")", toString(request.leafMethod));
  }
  if (request.fidelity == Fidelity::Skinned) {
    return fmt::format(R"(,"skin":{},"skin_scale":{},"skin_up":"{}")",
                       jsonFileName(request.skinPath), numberText(request.skinScale),
                       request.skinUp == UpAxis::Z ? "z" : "y");
  }
  return "";
}

std::string headerLine(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::vector<std::string> links;
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    links.push_back(inputs.avatar.skeleton().name(link));
  }
  const Eigen::Vector3d& origin = request.placement.origin;
  std::string text = R"({"format":"foretouch-results","version":1)";
  text += fmt::format(R"(,"tool":"{}","scene":{},"avatar":{},"motion":{})", FORETOUCH_VERSION,
                      jsonFileName(request.scenePath), jsonFileName(request.avatarPath),
                      jsonFileName(request.motionPath));
  text += fmt::format(R"(,"rate":{},"k":{},"frame_time":{},"steps":{})",
                      request.rateHz ? numberText(*request.rateHz) : "null", inputs.steps.stride,
                      numberText(inputs.clip.frameTimeS), inputs.steps.count);
  text += fmt::format(R"(,"tolerance":{},"fidelity":"{}")", numberText(request.tolerance),
                      toString(request.fidelity));
  text += fmt::format(R"(,"scale":{},"motion_up":"{}","place":[{},{},{},{}])",
                      numberText(request.motionScale), request.placement.motionUpZ ? "z" : "y",
                      numberText(origin.x()), numberText(origin.y()), numberText(origin.z()),
                      numberText(request.placement.yawDeg));
  text += fmt::format(R"(,"scene_scale":{},"up":"{}","ignore":{})", numberText(request.sceneScale),
                      request.sceneUp == UpAxis::Z ? "z" : "y", jsonList(request.ignore));
  if (request.scope != Scope::EveryLink) {
    text += fmt::format(R"(,"scope":"{}")", toString(request.scope));
  }
  if (request.budgetUs > 0) text += fmt::format(R"(,"budget_us":{})", request.budgetUs);
  text += policyField(request) + surfaceFields(request) + motionFields(request);
  text += fmt::format(R"(,"links":{},"unmatched_joints":{})", jsonList(links),
                      jsonList(inputs.match.unmatchedAvatar));
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
                                 numberText(answer.t0S), numberText(answer.t1S));
  for (std::size_t i = 0; i < answer.contacts.size(); ++i) {
    if (i > 0) text += ',';
    append(answer.contacts[i], answer, text);
  }
  return text + fmt::format("],\"latency_us\":{:.1f}}}\n", answer.latencyUs);
}

void StepFormat::append(const LinkContact& contact, const StepAnswer& answer,
                        std::string& text) const {
  ContactWords words;
  words.link = links_[static_cast<std::size_t>(contact.link)];
  words.reason = toString(contact.reason);
  std::string instant;
  if (contact.verdict != Verdict::Undecided) {
    words.object = objects_[static_cast<std::size_t>(scene_.object(contact.triangle))];
    instant = fmt::format(R"("time":{})",
                          numberText(answer.t0S + contact.toi * (answer.t1S - answer.t0S)));
    words.instant = instant;
  }
  appendContact(contact, words, text);
}

}  // namespace foretouch::tools
