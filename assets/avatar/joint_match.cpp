#include "assets/avatar/joint_match.h"

#include <cmath>
#include <unordered_map>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using JointIndex = std::unordered_map<std::string, JointId>;

JointIndex indexOf(const Skeleton& skeleton) {
  JointIndex index;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) index.emplace(skeleton.name(j), j);
  return index;
}

Result<Done> checkMap(const JointNameMap& names, const JointIndex& avatar, const JointIndex& clip) {
  for (const auto& [avatarName, clipName] : names) {
    if (avatar.count(avatarName) == 0) {
      return Error::of(ErrorCode::UnknownName, "the joint map names " + inQuotes(avatarName) +
                                                   ", which no avatar joint is called");
    }
    if (clip.count(clipName) == 0) {
      return Error::of(ErrorCode::UnknownName, "the joint map gives " + inQuotes(avatarName) +
                                                   " the clip joint " + inQuotes(clipName) +
                                                   ", which the clip does not have");
    }
  }
  return Done{};
}

}  // namespace

Result<JointMatch> matchJoints(const Skeleton& avatar, const Skeleton& clip,
                               const JointNameMap& names) {
  const JointIndex clipIndex = indexOf(clip);
  FORETOUCH_CHECK(checkMap(names, indexOf(avatar), clipIndex));

  JointMatch match;
  std::vector<bool> drives(countOf(clip.numJoints()), false);
  bool any = false;
  for (JointId j = 0; j < avatar.numJoints(); ++j) {
    const auto mapped = names.find(avatar.name(j));
    const auto found = clipIndex.find(mapped == names.end() ? avatar.name(j) : mapped->second);
    const JointId source = found == clipIndex.end() ? kNoParent : found->second;
    match.clipJointOf.push_back(source);
    if (source == kNoParent) {
      match.unmatchedAvatar.push_back(avatar.name(j));
    } else {
      drives[slotOf(source)] = true;
      any = true;
    }
  }
  for (JointId j = 0; j < clip.numJoints(); ++j) {
    if (!drives[slotOf(j)]) match.unmatchedClip.push_back(clip.name(j));
  }
  if (any) return match;
  return Error::of(ErrorCode::Mismatch,
                   "no joint of the avatar (first: " + inQuotes(avatar.name(0)) +
                       ") has the name of a joint of the clip (first: " + inQuotes(clip.name(0)) +
                       "); expected common names, or a joint map");
}

std::optional<double> suspiciousSize(const Skeleton& avatar, const Skeleton& clip,
                                     const JointMatch& match) {
  constexpr double kSuspiciousRatio = 2.0;  // people differ by less, centimetres and inches by more
  double ofAvatar = 0.0;
  double ofClip = 0.0;
  for (JointId joint = 0; joint < avatar.numJoints(); ++joint) {
    const JointId source = match.clipJointOf[slotOf(joint)];
    if (source == kNoParent || avatar.parent(joint) == kNoParent) continue;
    ofAvatar += avatar.restOffset(joint).norm();
    ofClip += clip.restOffset(source).norm();
  }
  if (!(ofAvatar > 0.0 && ofClip > 0.0)) return std::nullopt;
  const double ratio = ofClip / ofAvatar;
  if (ratio <= kSuspiciousRatio && ratio >= 1.0 / kSuspiciousRatio) return std::nullopt;
  return ratio;
}

Pose poseOfAvatar(const Skeleton& avatar, const Clip& clip, const JointMatch& match,
                  std::size_t frame) {
  FORETOUCH_ASSERT(frame < clip.frames.size());
  FORETOUCH_ASSERT(match.clipJointOf.size() == countOf(avatar.numJoints()));
  const Pose& source = clip.frames[frame];
  Pose pose = restPose(avatar);
  for (std::size_t j = 0; j < match.clipJointOf.size(); ++j) {
    if (match.clipJointOf[j] == kNoParent) continue;
    const auto c = static_cast<std::size_t>(match.clipJointOf[j]);
    if (clip.hasRotation[c]) pose.rotations[j] = source.rotations[c];
    if (clip.hasTranslation[c]) pose.translations[j] = source.translations[c];
  }
  return pose;
}

Pose placed(const Skeleton& skeleton, Pose pose, const Placement& placement) {
  constexpr double kHalfRadiansPerDegree = 3.14159265358979323846 / 360.0;
  const double halfYaw = placement.yawDeg * kHalfRadiansPerDegree;
  const Quaternion yaw(std::cos(halfYaw), 0.0, std::sin(halfYaw), 0.0);
  const double half = std::sqrt(0.5);
  const Quaternion upright(half, -half, 0.0, 0.0);  // a quarter turn about X takes +Z to +Y
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    if (skeleton.parent(j) != kNoParent) continue;
    Quaternion& rotation = pose.rotations[slotOf(j)];
    Eigen::Vector3d& position = pose.translations[slotOf(j)];
    if (placement.motionUpZ) {
      rotation = upright * rotation;
      position = Eigen::Vector3d(position.x(), position.z(), -position.y());
    }
    if (placement.yawDeg != 0.0) {  // a product with the identity is not free of rounding
      rotation = yaw * rotation;
      position = yaw * position;
    }
    position += placement.origin;
    rotation = unitQuaternion(rotation).value_or(rotation);
  }
  return pose;
}

}  // namespace foretouch
