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

std::string headerLine(const ReplayInputs& inputs) {
  ReplayRequest request = inputs.request;
  Settings settings;
  addMotionSetting(settings, request, "", "");
  addRateSetting(settings, request);
  addClipSettings(settings, request);
  addSceneSettings(settings, request);
  addQuerySettings(settings, request);
  addReplayQuerySettings(settings, request);
  std::vector<std::string> links;
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    links.push_back(inputs.avatar.skeleton().name(link));
  }
  std::string text =
      fmt::format(R"({{"format":"foretouch-results","version":1,"tool":"{}")", FORETOUCH_VERSION);
  text += headerField(settings, "scene");
  text += fmt::format(R"(,"avatar":{})", jsonFileName(request.avatarPath));
  text += headerFields(settings, {"motion", "rate"});
  text += fmt::format(R"(,"k":{},"frame_time":{},"steps":{})", inputs.steps.stride,
                      numberText(inputs.clip.frameTimeS), inputs.steps.count);
  text += headerFields(settings, {"tolerance", "fidelity", "scale", "motion_up", "place",
                                  "scene_scale", "up", "ignore", "scope", "budget_us", "policy",
                                  "leaves", "skin", "skin_scale", "skin_up", "animation", "robot"});
  return text + fmt::format(",\"links\":{},\"unmatched_joints\":{}}}\n", jsonList(links),
                            jsonList(inputs.match.unmatchedAvatar));
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
