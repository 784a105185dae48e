#include "tools/replay/results_writer.h"

#include <algorithm>
#include <filesystem>

#include "lss/index.h"
#include "tools/contact_json.h"
#include "tools/json_line.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

void beginResults(JsonWriter& out, const char* format) {
  out.beginObject();
  out.field("format", format);
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

void writeSelf(const PairRules& rules, const Skeleton& skeleton, const std::string& path,
               JsonWriter& out) {
  writeObject("self", out, [&] {
    if (!path.empty()) writeFileName("file", path, out);
    out.field("pairs", rules.numPairs());
    out.field("asked", rules.numAsked());
    out.field("radii", rules.radii().size());
    writeObjects("left_out", rules.leftOut(), out, [&](const LeftOutPair& pair) {
      out.field("a", skeleton.name(pair.a));
      out.field("b", skeleton.name(pair.b));
      out.field("reason", toString(pair.reason));
    });
  });
}

std::string headerLine(const ReplayInputs& inputs) {
  ReplayRequest request = inputs.request;
  Settings settings;
  addMotionSetting(settings, request, "", "");
  addRateSetting(settings, request);
  addClipSettings(settings, request);
  addCutSettings(settings, request);
  addSceneSettings(settings, request);
  addQuerySettings(settings, request);
  addReplayQuerySettings(settings, request);
  addTouchSettings(settings, request);
  std::string text;
  JsonWriter out(text);
  beginResults(out);
  writeHeaderField(settings, "scene", out);
  writeFileName("avatar", request.avatarPath, out);
  writeHeaderFields(settings, {"motion", "rate"}, out);
  out.field("k", inputs.steps.stride);
  if (inputs.steps.first > 0) out.field("first_frame", inputs.steps.first);
  out.field("frame_time", inputs.clip.frameTimeS);
  if (inputs.clip.framesPerRow > 1) out.field("frames_per_row", inputs.clip.framesPerRow);
  if (inputs.curve) {
    out.field("between", toString(inputs.curve->model));
    out.field("pieces", inputs.curve->pieces);
    out.field("off_m", inputs.curve->offM);
  }
  out.field("steps", inputs.steps.count);
  writeHeaderFields(settings,
                    {"tolerance",     "fidelity",  "scale",       "motion_up",  "place",
                     "scene_scale",   "up",        "ignore",      "scope",      "pass_separating",
                     "budget_us",     "policy",    "leaves",      "skin",       "skin_scale",
                     "skin_up",       "animation", "robot",       "columns",    "row_rate",
                     "quaternion",    "angles",    "table_scale", "ground",     "ground_angle",
                     "ground_height", "from",      "to",          "skip_t_pose"},
                    out);
  if (inputs.query.self) {
    writeSelf(*inputs.query.self, inputs.avatar.skeleton(), request.pairsPath, out);
  }
  writeLinkNames(inputs.avatar, out);
  out.field("unmatched_joints", inputs.match.unmatchedAvatar);
  out.endObject();
  return text + "\n";
}

StepFormat::StepFormat(const Avatar& avatar, const Scene& scene, AskedLists asked)
    : scene_(scene), asked_(asked) {
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
  if (answer.row) out.field("row", *answer.row);
  out.field("t0", answer.t0S);
  out.field("t1", answer.t1S);
  const auto writeOne = [&](const LinkContact& contact) { write(contact, answer, out); };
  writeObjects("contacts", answer.contacts, out, writeOne);
  if (asked_.objects) writeObjects("objects", answer.objects, out, writeOne);
  if (asked_.pairs) {
    writeObjects("pairs", answer.pairs, out,
                 [&](const PairContact& contact) { write(contact, answer, out); });
  }
  out.key("latency_us");
  out.fixed(answer.latencyUs, 1);
  out.endObject();
  return text + "\n";
}

void StepFormat::write(const PairContact& contact, const StepAnswer& answer,
                       JsonWriter& out) const {
  ContactWords words;
  words.link = links_[slotOf(contact.link)];
  words.other = links_[slotOf(contact.other)];
  words.penetrationAtMost = contact.penetrationAtMost;
  words.timeS = timeOf(contact, answer.t0S, answer.t1S);
  writeContact(contact, words, out);
}

void StepFormat::write(const LinkContact& contact, const StepAnswer& answer,
                       JsonWriter& out) const {
  ContactWords words;
  words.link = links_[slotOf(contact.link)];
  if (contact.verdict != Verdict::Undecided) {
    words.object = objects_[slotOf(scene_.object(contact.triangle))];
    words.timeS = timeOf(contact, answer.t0S, answer.t1S);
  }
  writeContact(contact, words, out);
}

}  // namespace foretouch::tools
