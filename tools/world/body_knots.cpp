#include "tools/world/body_knots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/clip/rigid_poses.h"
#include "assets/near_names.h"
#include "lss/index.h"
#include "tools/inputs/clip_cut.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/lost_frames.h"
#include "tools/inputs/own_pairs.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/step_selection.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

Pose ofOneJoint(const RigidPose& pose) {
  return {{pose.rotation}, {pose.translation}};
}

/// A frame of a clip, and its instant of world time.
struct TimedFrame {
  std::int64_t frame = 0;
  std::int64_t utimeUs = 0;
};

/// From where on the clip is played: behind its T-pose, where that is left out.
Result<Done> skipTPose(const FileBody& body, const Motion& motion, const std::string& world,
                       ClipTiming& timing) {
  if (!body.clip.cut.skipsTPose) return Done{};
  const auto atLine = [&](Error error) {
    return Error::inLine(world, body.clipLine, error.code, "[clip]: " + describe(error));
  };
  FORETOUCH_TRY_OR(atLine, const auto range, framesOf(body.clip, motion.clip, motion.isUpright));
  const double beginS = static_cast<double>(range.first) * motion.clip.frameTimeS;
  timing.fromUs = std::max(timing.fromUs, inMicroseconds(beginS));
  return Done{};
}

/// The frames that a body takes of its clip. Errors name the clip, or the world's line.
Result<std::vector<TimedFrame>> timedFramesOf(const FileBody& body, const Motion& motion,
                                              const std::string& world) {
  const Clip& clip = motion.clip;
  FORETOUCH_TRY(const auto steps,
                inFile(selectSteps(clip, body.clip.rateHz), body.clip.motionPath));
  ClipTiming timing = body.timing;
  FORETOUCH_CHECK(skipTPose(body, motion, world, timing));
  // Half a frame: what one types as an instant of a frame is one, whatever its last digit.
  const double slackUs = 0.5 * clip.frameTimeS * kUsPerS;
  const double firstUs = static_cast<double>(timing.fromUs) - slackUs;
  const double lastUs = timing.untilUs ? static_cast<double>(*timing.untilUs) + slackUs
                                       : std::numeric_limits<double>::infinity();
  std::vector<TimedFrame> frames;
  for (std::int64_t step = 0; step <= steps.count; ++step) {
    const std::int64_t frame = step * steps.stride;
    const double clipS = static_cast<double>(frame) * clip.frameTimeS;
    if (clipS * kUsPerS < firstUs || clipS * kUsPerS > lastUs) continue;
    const double sinceS = (clipS - static_cast<double>(timing.fromUs) / kUsPerS) / timing.speed;
    const std::int64_t utimeUs = timing.startUs + (isTime(sinceS) ? inMicroseconds(sinceS) : 0);
    if (!isTime(sinceS) || std::abs(utimeUs) > kMostUtimeUs) {
      return Error::inLine(world, body.clipLine, ErrorCode::OutOfRange,
                           "[clip]: expected all of the clip within 285 years of zero");
    }
    const TimedFrame next{frame, utimeUs};
    if (!frames.empty() && next.utimeUs <= frames.back().utimeUs) {
      return Error::inLine(world, body.clipLine, ErrorCode::OutOfRange,
                           fmt::format("[clip]: expected frames at least a microsecond apart, "
                                       "found less from frame {} to {}",
                                       frames.back().frame, frame));
    }
    frames.push_back(next);
  }
  if (!frames.empty()) return frames;
  return Error::inLine(
      world, body.clipLine, ErrorCode::Empty,
      fmt::format("[clip]: expected a frame from {} s{} of the clip, which lasts "
                  "{} s",
                  inSeconds(timing.fromUs),
                  timing.untilUs ? fmt::format(" to {} s", inSeconds(*timing.untilUs)) : "",
                  clip.durationS()));
}

/// The clip's frames between those that are taken, at their instants.
Result<std::vector<BodyKnot>> leftOutOf(const PlacedClip& placed,
                                        const std::vector<TimedFrame>& frames,
                                        const LostFrames& lost) {
  std::vector<BodyKnot> leftOut;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const TimedFrame &from = frames[i - 1], &to = frames[i];
    const double perFrame =
        static_cast<double>(to.utimeUs - from.utimeUs) / static_cast<double>(to.frame - from.frame);
    for (std::int64_t frame = from.frame + 1; frame < to.frame; ++frame) {
      if (!lost.linksAt(frame).empty()) continue;
      FORETOUCH_TRY(auto pose, poseAtFrame(placed, frame));
      const double since = perFrame * static_cast<double>(frame - from.frame);
      leftOut.push_back({from.utimeUs + std::llround(since), std::move(pose), -1});
    }
  }
  return leftOut;
}

/// The joint of the clip that moves a prop.
Result<JointId> jointOf(const FileBody& body, const Skeleton& clip, const std::string& world) {
  std::vector<std::string> names;
  std::vector<JointId> roots;
  for (JointId joint = 0; joint < clip.numJoints(); ++joint) {
    names.push_back(clip.name(joint));
    if (clip.parent(joint) == kNoParent) roots.push_back(joint);
  }
  if (body.joint.empty()) {
    if (roots.size() == 1) return roots.front();
    return Error::inLine(world, body.clipLine, ErrorCode::Mismatch,
                         fmt::format("[clip]: expected joint, the one of the clip that moves the "
                                     "prop, as the clip has {} roots",
                                     roots.size()));
  }
  if (const auto joint = clip.find(body.joint)) return *joint;
  return Error::inLine(world, body.clipLine, ErrorCode::UnknownName,
                       "[clip] joint: expected a joint of the clip, found " + inQuotes(body.joint) +
                           didYouMean(body.joint, names));
}

/// The joint's frame in the clip's world.
RigidPose frameOf(const Skeleton& skeleton, const Pose& pose, JointId joint) {
  RigidPose frame;
  for (JointId at = joint; at != kNoParent; at = skeleton.parent(at)) {
    const Quaternion& rotation = pose.rotations[slotOf(at)];
    frame.translation = rotation * frame.translation + pose.translations[slotOf(at)];
    frame.rotation = (rotation * frame.rotation).normalized();
  }
  return frame;
}

}  // namespace

Result<BodyKnots> KnotLoader::load(const FileBody& body, const BodyShape& shape,
                                   const std::string& world) {
  const bool isOfFile = !body.shape.avatarPath.empty();
  return isOfFile ? ofAvatar(body, *shape.avatar, world) : ofProp(body, shape, world);
}

Result<std::shared_ptr<const Motion>> KnotLoader::motionOf(const ClipRequest& request) {
  const MotionRequest motion = motionRequestOf(request);
  std::string key = fmt::format("{}\n{}\n{}\n{}\n{}\n{}", motion.path, motion.scale.value_or(0.0),
                                motion.up ? static_cast<int>(*motion.up) : -1, motion.animation,
                                motion.rateHz, motion.robot);
  for (const std::string& path : motion.packagePaths) key += "\n" + path;
  const JointTableOptions& table = motion.table;
  for (const std::string& column : table.columns) key += "\n" + column;
  key += fmt::format("\n{}\n{}\n{}\n{}", table.rateHz.value_or(0.0),
                     table.quaternion ? static_cast<int>(*table.quaternion) : -1, table.isInDegrees,
                     table.metresPerUnit.value_or(0.0));
  auto known = motions_.find(key);
  if (known == motions_.end()) {
    FORETOUCH_TRY(auto read, readMotion(motion));
    known = motions_.emplace(key, std::make_shared<const Motion>(std::move(read))).first;
  }
  return known->second;
}

Result<Done> KnotLoader::countPoses(const FileBody& body, std::size_t joints, std::size_t poses,
                                    const std::string& world) {
  jointPoses_ += joints * poses;
  if (poses <= kMaxKnots && jointPoses_ <= kMostJointPoses) return Done{};
  return Error::inLine(world, body.line, ErrorCode::LimitExceeded,
                       fmt::format("[[body]] {}: expected at most {} poses of a body, and {} poses "
                                   "times joints of all bodies",
                                   inQuotes(body.name), kMaxKnots, kMostJointPoses));
}

Result<BodyKnots> KnotLoader::ofAvatar(const FileBody& body, const Avatar& avatar,
                                       const std::string& world) {
  BodyKnots found;
  const std::string& path = body.clip.motionPath;
  if (path.empty()) {
    if (!body.asksSelf) return found;
    if (!body.pairsPath.empty()) {
      FORETOUCH_TRY(found.self, readPairsFile(body.pairsPath, avatar));
      return found;
    }
    auto rules = PairRules::derive(avatar);
    if (!rules.ok()) {
      return Error::inLine(world, body.line, rules.error().code,
                           "[[body]] self: " + rules.error().message);
    }
    found.self = std::move(rules).value();
    return found;
  }
  found.file = path;
  FORETOUCH_TRY(const auto motion, motionOf(body.clip));
  Clip clip = motion->clip;
  FORETOUCH_CHECK(followByParts(avatar.skeleton(), body.clip.mapPath, path, clip));
  const auto match = matchWithMap(avatar.skeleton(), clip.skeleton, body.clip.mapPath, path);
  if (!match.ok()) return match.error();
  FORETOUCH_TRY(const auto frames, timedFramesOf(body, *motion, world));
  FORETOUCH_CHECK(countPoses(body, countOf(avatar.numLinks()), frames.size(), world));
  const PlacedClip placed{avatar, clip, match.value(), body.clip.placement, motion->isUpright,
                          path};
  const LostFrames lost(avatar, clip, match.value());
  for (const TimedFrame& timed : frames) {
    if (lost.isAllLost(timed.frame)) continue;
    const std::vector<LinkId> links = lost.linksAt(timed.frame);
    if (!links.empty()) found.lostLinks[timed.utimeUs] = links;
    FORETOUCH_TRY(auto pose, poseAtFrame(placed, timed.frame));
    found.knots.push_back({timed.utimeUs, std::move(pose), -1});
  }
  if (!body.boundsPath.empty()) {
    FORETOUCH_TRY(found.leftOut, leftOutOf(placed, frames, lost));
    FORETOUCH_CHECK(countPoses(body, countOf(avatar.numLinks()), found.leftOut.size(), world));
  }
  found.remarks = remarksOnClip(avatar, clip, match.value(), body.shape.avatarPath, path);
  if (body.asksSelf) {
    WorldRequest request;
    request.asksSelf = true;
    request.pairsPath = body.pairsPath;
    FORETOUCH_TRY(found.self, pairRulesFor(request, body.clip, avatar, clip, match.value()));
  }
  return found;
}

Result<BodyKnots> KnotLoader::ofProp(const FileBody& body, const BodyShape& shape,
                                     const std::string& world) {
  BodyKnots found;
  found.file = world;
  for (const FilePose& pose : body.poses) {
    found.knots.push_back({pose.utimeUs, ofOneJoint(pose.pose), pose.line});
  }
  if (!body.posesPath.empty()) {
    found.file = body.posesPath;
    FORETOUCH_TRY(const auto poses, readRigidPoses(body.posesPath));
    for (const TimedRigidPose& timed : poses) {
      if (!isTime(timed.timeS)) {
        return Error::inLine(body.posesPath, timed.line, ErrorCode::OutOfRange,
                             "expected a time within 285 years of zero");
      }
      found.knots.push_back({inMicroseconds(timed.timeS), ofOneJoint(timed.pose), timed.line});
    }
  }
  if (!body.clip.motionPath.empty()) {
    found.file = body.clip.motionPath;
    FORETOUCH_TRY(const auto motion, motionOf(body.clip));
    const Clip& clip = motion->clip;
    FORETOUCH_TRY(const auto joint, jointOf(body, clip.skeleton, world));
    FORETOUCH_TRY(const auto frames, timedFramesOf(body, *motion, world));
    Placement placement = body.clip.placement;
    placement.motionUpZ = placement.motionUpZ && !motion->isUpright;
    for (const TimedFrame& timed : frames) {
      const Pose& frame = clip.frames[slotOf(timed.frame)];
      found.knots.push_back(
          {timed.utimeUs,
           foretouch::placed(shape.skeleton, ofOneJoint(frameOf(clip.skeleton, frame, joint)),
                             placement),
           -1});
    }
    for (const std::string& note : clip.notes) {
      found.remarks.push_back(body.clip.motionPath + ": " + note);
    }
  }
  FORETOUCH_CHECK(countPoses(body, 1, found.knots.size(), world));
  for (BodyKnot& knot : found.knots) {
    const auto valid = validate(shape.skeleton, knot.pose);
    if (valid.ok()) continue;
    return Error::inLine(found.file, knot.line, valid.error().code, valid.error().message);
  }
  return found;
}

}  // namespace foretouch::tools
