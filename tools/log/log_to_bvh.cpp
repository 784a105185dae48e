#include "tools/log/log_to_bvh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "network/log/event_log.h"
#include "network/wire/codec.h"
#include "tools/console.h"
#include "tools/log/bvh_text.h"
#include "tools/microseconds.h"
#include "tools/settings/channel_names.h"

namespace foretouch::tools {
namespace {

Error refusal(ErrorCode code, std::string message) {
  return {code, "", -1, -1, std::move(message)};
}

/// The log's data of one avatar.
struct Recording {
  std::map<std::int64_t, RawSkeleton> skeletons;  ///< By hash.
  std::vector<PoseMessage> poses;                 ///< Of one session and hash, sequence growing.
  std::int64_t late = 0;                          ///< Came twice, or after a later one.
};

Result<Done> addPose(PoseMessage& pose, Recording& recording) {
  if (!recording.poses.empty()) {
    const PoseMessage& last = recording.poses.back();
    if (pose.session != last.session || pose.skeletonHash != last.skeletonHash) {
      return refusal(ErrorCode::Mismatch,
                     fmt::format("expected poses of one session and skeleton; pose {} of session "
                                 "{} follows session {}",
                                 pose.sequence, pose.session, last.session));
    }
    if (pose.sequence <= last.sequence || pose.utimeUs <= last.utimeUs) {
      ++recording.late;
      return Done{};
    }
  }
  recording.poses.push_back(std::move(pose));
  return Done{};
}

Result<Done> addEvent(const LogEvent& event, const LogToBvhRequest& request,
                      const ChannelNames& channels, Recording& recording) {
  if (event.channel == channels.skeleton) {
    SkeletonMessage message;
    if (decode(event.payload, message) == Reject::None && message.avatar == request.avatar) {
      recording.skeletons.emplace(message.hash, std::move(message.skeleton));
    }
  } else if (event.channel == channels.pose) {
    PoseMessage message;
    if (decode(event.payload, message) == Reject::None && message.avatar == request.avatar) {
      return addPose(message, recording);
    }
  }
  return Done{};
}

Result<Recording> readRecording(const LogToBvhRequest& request, const ChannelNames& channels,
                                LogLoss& loss) {
  Recording recording;
  const auto read = readEvents(request.logPath, loss,
                               [&](const LogEvent& event, const EventLogReader&) -> Result<bool> {
                                 FORETOUCH_CHECK(addEvent(event, request, channels, recording));
                                 return true;
                               });
  if (!read.ok()) return read.error();
  if (recording.poses.empty()) {
    return refusal(ErrorCode::Empty,
                   fmt::format("holds no pose of avatar {} that can be read", request.avatar));
  }
  return recording;
}

Result<Pose> poseOf(const PoseMessage& message, const Skeleton& skeleton,
                    std::vector<bool>& hasTranslation) {
  Pose pose = restPose(skeleton);
  std::vector<bool> isKnown(pose.rotations.size(), false);
  const auto placeOf = [&](std::int32_t joint) -> std::optional<std::size_t> {
    if (joint < 0 || joint >= skeleton.numJoints()) return std::nullopt;
    return slotOf(joint);
  };
  for (const PoseJoint& joint : message.joints) {
    const auto j = placeOf(joint.joint);
    if (!j || (joint.flags & kJointValid) == 0) continue;
    pose.rotations[*j] = joint.rotation;
    isKnown[*j] = true;
  }
  for (const PoseTranslation& translation : message.translations) {
    const auto j = placeOf(translation.joint);
    if (!j) continue;
    pose.translations[*j] = translation.translation;
    hasTranslation[*j] = true;
  }
  const auto unknown = std::find(isKnown.begin(), isKnown.end(), false);
  if (unknown != isKnown.end()) {
    const auto joint = static_cast<JointId>(unknown - isKnown.begin());
    return refusal(ErrorCode::Mismatch,
                   fmt::format("pose {} does not say where joint {} is; a BVH file needs complete "
                               "poses",
                               message.sequence, inQuotes(skeleton.name(joint))));
  }
  return validatedPose(skeleton, std::move(pose));
}

/// Seconds between frames: the mean if all are equally far apart, else the most frequent.
double spacingS(const std::vector<PoseMessage>& poses, std::vector<std::string>& notes) {
  constexpr double kRoundingUs = 1.0;
  if (poses.size() < 2) return 1.0;
  const auto steps = static_cast<double>(poses.size() - 1);
  const double meanUs = static_cast<double>(poses.back().utimeUs - poses.front().utimeUs) / steps;
  std::vector<double> spacings;
  double worstUs = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto sinceFirst = static_cast<double>(poses[i].utimeUs - poses.front().utimeUs);
    worstUs = std::max(worstUs, std::abs(sinceFirst - static_cast<double>(i) * meanUs));
    spacings.push_back(static_cast<double>(poses[i].utimeUs - poses[i - 1].utimeUs));
  }
  if (worstUs <= kRoundingUs) return meanUs / kUsPerS;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  const double usualUs = *middle;
  notes.push_back(fmt::format(
      "its poses are not equally far apart, as the frames of a BVH file are: each is given {:.6g} "
      "s, {:.6g} s in all instead of {:.6g} s",
      usualUs / kUsPerS, steps * usualUs / kUsPerS, steps * meanUs / kUsPerS));
  return usualUs / kUsPerS;
}

std::vector<std::string> notesOn(const Recording& recording) {
  std::vector<std::string> notes;
  const std::int64_t sent = recording.poses.back().sequence - recording.poses.front().sequence + 1;
  const std::int64_t lost = sent - static_cast<std::int64_t>(recording.poses.size());
  if (lost > 0) notes.push_back(fmt::format("{} poses between the frames are lost", lost));
  if (recording.late > 0) {
    notes.push_back(
        fmt::format("{} poses that came twice or too late are left out", recording.late));
  }
  return notes;
}

Result<BvhOfLog> convert(const LogToBvhRequest& request, LogLoss& loss) {
  FORETOUCH_TRY(const auto channels, channelNames(request.suffix));
  FORETOUCH_TRY(const auto recording, readRecording(request, channels, loss));
  const auto raw = recording.skeletons.find(recording.poses.front().skeletonHash);
  if (raw == recording.skeletons.end()) {
    return refusal(ErrorCode::Empty, fmt::format("holds poses of avatar {}, but not the skeleton "
                                                 "that they are about",
                                                 request.avatar));
  }
  FORETOUCH_TRY(const auto skeleton, Skeleton::build(raw->second));
  std::vector<bool> hasTranslation(countOf(skeleton.numJoints()), false);
  std::vector<Pose> poses;
  for (const PoseMessage& message : recording.poses) {
    FORETOUCH_TRY(auto pose, poseOf(message, skeleton, hasTranslation));
    poses.push_back(std::move(pose));
  }
  BvhOfLog bvh;
  bvh.notes = notesOn(recording);
  bvh.frames = static_cast<std::int64_t>(poses.size());
  const double frameTimeS =
      std::clamp(spacingS(recording.poses, bvh.notes), kMinFrameTimeS, kMaxFrameTimeS);
  FORETOUCH_TRY(bvh.text, bvhText(skeleton, hasTranslation, poses, frameTimeS));
  return bvh;
}

}  // namespace

Result<BvhOfLog> logToBvh(const LogToBvhRequest& request, LogLoss& loss) {
  auto bvh = convert(request, loss);
  if (!bvh.ok()) return inFile(bvh.error(), request.logPath);
  return bvh;
}

}  // namespace foretouch::tools
