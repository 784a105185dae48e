#include "tools/solid/solid_lines.h"

#include <cstring>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "network/wire/message_fields.h"
#include "tools/fields_json.h"
#include "tools/json_line.h"
#include "tools/replay/results_writer.h"
#include "tools/settings/file_mark.h"
#include "tools/solid_json.h"

namespace foretouch::tools {
namespace {

void writeNamedPose(const char* name, const Pose& pose, JsonWriter& out) {
  writeObject(name, out, [&] { writePose(pose, out); });
}

Result<Done> writeFile(const char* name, const std::string& path, JsonWriter& out) {
  writeFileName(name, path, out);
  FORETOUCH_TRY(const auto mark, markOfFile(path));
  out.field(std::string(name) + "_mark", mark);
  return Done{};
}

void writeOptions(const SolidOptions& options, const Avatar& avatar, JsonWriter& out) {
  writeObject("options", out, [&] {
    out.field("skin", options.skin);
    out.field("tolerance", options.tolerance);
    out.field("catch_up", options.catchUp);
    out.list("visibility", options.visibility, [&](double value) { out.value(value); });
    out.field("floor", toString(options.floor));
    out.key("feet");
    out.beginArray();
    for (std::size_t link = 0; link < options.feet.size(); ++link) {
      if (options.feet[link]) out.value(avatar.skeleton().name(static_cast<LinkId>(link)));
    }
    out.endArray();
    out.field("most_lift", options.mostLift);
    out.field("most_deviation", options.mostDeviation);
    out.field("most_limb_deviation", options.mostLimbDeviation);
    out.field("patience", options.patience);
    out.field("snap", options.maySnap);
    out.field("snap_notice", options.snapNotice);
    out.field("around", options.aroundPerTick);
    out.field("around_in_all", options.aroundInAll);
    out.field("placing_reach", options.placingReach);
    out.field("work", options.workBudget);
  });
}

}  // namespace

std::string markOfPose(const Pose& pose) {
  std::string bits;
  bits.reserve((pose.rotations.size() * 4 + pose.translations.size() * 3) * sizeof(double));
  const auto append = [&](double x) {
    char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    bits.append(bytes, sizeof x);
  };
  for (const Quaternion& q : pose.rotations) {
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) append(x);
  }
  for (const Eigen::Vector3d& p : pose.translations) {
    for (const double x : p) append(x);
  }
  return markOfText(bits);
}

SolidLines::SolidLines(const ReplayInputs& inputs, SolidOptions options)
    : inputs_(inputs), options_(std::move(options)) {
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    links_.push_back(jsonString(inputs.avatar.skeleton().name(link)));
  }
  for (const std::string& name : inputs.scene.objectNames()) objects_.push_back(jsonString(name));
}

/// Closes the object that `open` leaves open.
std::string SolidLines::marked(std::string open) {
  mark_ = markOfText(open, mark_);
  return std::move(open) + ",\"mark\":\"" + mark_ + "\"}\n";
}

Result<std::string> SolidLines::header() {
  ReplayRequest request = inputs_.request;
  Settings settings;
  addRateSetting(settings, request);
  addClipSettings(settings, request);
  addCutSettings(settings, request);
  addSceneSettings(settings, request);
  addQuerySettings(settings, request);
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("format", kSolidFormat);
  out.field("version", kSolidVersion);
  out.field("tool", FORETOUCH_VERSION);
  FORETOUCH_CHECK(writeFile("scene", request.scenePath, out));
  FORETOUCH_CHECK(writeFile("avatar", request.avatarPath, out));
  FORETOUCH_CHECK(writeFile("motion", request.motionPath, out));
  writeHeaderFields(settings, {"rate"}, out);
  out.field("k", inputs_.steps.stride);
  if (inputs_.steps.first > 0) out.field("first_frame", inputs_.steps.first);
  out.field("frame_time", inputs_.clip.frameTimeS);
  out.field("ticks", ticksOf(inputs_));
  writeHeaderFields(
      settings,
      {"scale", "motion_up", "place", "scene_scale", "up", "ignore", "animation", "robot",
       "columns", "row_rate", "quaternion", "angles", "table_scale", "from", "to", "skip_t_pose"},
      out);
  writeOptions(options_, inputs_.avatar, out);
  if (options_.self) {
    out.rawField("self", nlohmann::json::parse(formatPairs(*options_.self, inputs_.avatar)).dump());
  }
  writeLinkNames(inputs_.avatar, out);
  out.field("unmatched_joints", inputs_.match.unmatchedAvatar);
  return marked(std::move(text));
}

std::string SolidLines::line(const PlayedTick& played) {
  const SolidTick& answer = played.answer;
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("tick", played.tick);
  out.field("t", played.timeS);
  writeFields(answer, out, wire::shownState<SolidTick>());
  out.field("deviation", answer.deviation);
  out.field("lift", answer.lift);
  out.field("clearance", played.numPieces() > 0 && answer.isCertified ? answer.clearance : 0.0);
  if (answer.snapInS >= 0.0) out.field("snap_in", answer.snapInS);
  if (const Pose* const start = played.start()) {
    writeNamedPose("start", *start, out);
  } else if (!shownMark_.empty() && played.numPieces() > 0) {
    out.field("from", shownMark_);
  }
  out.key("way");
  out.beginArray();
  for (std::size_t i = 0; i < played.numPieces(); ++i) {
    out.beginObject();
    out.field("t", played.timeOfPiece(i));
    writePose(played.piece(i), out);
    out.endObject();
  }
  out.endArray();
  if (answer.state == SolidState::Placing || !played.isShownTracked()) {
    writeNamedPose("tracked", played.tracked, out);
  }
  out.list("deviations", answer.linkDeviation, [&](double value) { out.value(value); });
  writeObject("joints", out, [&] {
    for (std::size_t joint = 0; joint < answer.joints.size(); ++joint) {
      if (answer.joints[joint] == SolidJointState::Free) continue;
      out.field(inputs_.avatar.skeleton().name(static_cast<JointId>(joint)),
                toString(answer.joints[joint]));
    }
  });
  writeObjects("contacts", answer.contacts, out,
               [&](const SolidContact& contact) { write(contact, out); });
  writeCounters(answer.counters, out);
  shownMark_ = answer.state == SolidState::Placing ? "" : markOfPose(answer.shown);
  return marked(std::move(text));
}

std::string SolidLines::last(const std::string& fields) {
  return marked("{\"summary\":{" + fields + "}");
}

void SolidLines::write(const SolidContact& contact, JsonWriter& out) const {
  const bool isOfScene = contact.triangle >= 0;
  const std::string& touched = isOfScene ? objects_[slotOf(inputs_.scene.object(contact.triangle))]
                                         : links_[slotOf(contact.other)];
  writeSolidContact(contact, links_[slotOf(contact.link)], touched, out);
}

}  // namespace foretouch::tools
