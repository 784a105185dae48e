#include "tools/replay/results_writer.h"

#include <algorithm>
#include <filesystem>

#include "lss/index.h"
#include "tools/contact_json.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

void beginResults(JsonWriter& out) {
  out.beginObject();
  out.field("format", "foretouch-results");
  out.field("version", 1);
  out.field("tool", FORETOUCH_VERSION);
}

void writeFileName(const char* name, const std::string& path, JsonWriter& out) {
  out.field(name, std::filesystem::path(path).filename().string());
}

void writeLinkNames(const Avatar& avatar, JsonWriter& out) {
  out.key("links");
  out.beginArray();
  for (LinkId link = 0; link < avatar.numLinks(); ++link) out.value(avatar.skeleton().name(link));
  out.endArray();
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
  std::string text;
  JsonWriter out(text);
  beginResults(out);
  writeHeaderField(settings, "scene", out);
  writeFileName("avatar", request.avatarPath, out);
  writeHeaderFields(settings, {"motion", "rate"}, out);
  out.field("k", inputs.steps.stride);
  out.field("frame_time", inputs.clip.frameTimeS);
  out.field("steps", inputs.steps.count);
  writeHeaderFields(settings,
                    {"tolerance", "fidelity", "scale", "motion_up", "place", "scene_scale", "up",
                     "ignore", "scope", "budget_us", "policy", "leaves", "skin", "skin_scale",
                     "skin_up", "animation", "robot"},
                    out);
  writeLinkNames(inputs.avatar, out);
  out.field("unmatched_joints", inputs.match.unmatchedAvatar);
  out.endObject();
  return text + "\n";
}

StepFormat::StepFormat(const Avatar& avatar, const Scene& scene) : scene_(scene) {
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    links_.push_back(jsonString(avatar.skeleton().name(link)));
  }
  for (const std::string& name : scene.objectNames()) objects_.push_back(jsonString(name));
}

std::string StepFormat::line(const StepAnswer& answer) const {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("step", answer.step);
  out.field("t0", answer.t0S);
  out.field("t1", answer.t1S);
  out.list("contacts", answer.contacts,
           [&](const LinkContact& contact) { write(contact, answer, out); });
  out.key("latency_us");
  out.fixed(answer.latencyUs, 1);
  out.endObject();
  return text + "\n";
}

void StepFormat::write(const LinkContact& contact, const StepAnswer& answer,
                       JsonWriter& out) const {
  ContactWords words;
  words.link = links_[slotOf(contact.link)];
  if (contact.verdict != Verdict::Undecided) {
    words.object = objects_[slotOf(scene_.object(contact.triangle))];
    words.timeS = timeOf(contact, answer.t0S, answer.t1S);
  }
  out.beginObject();
  writeContact(contact, words, out);
  out.endObject();
}

}  // namespace foretouch::tools
