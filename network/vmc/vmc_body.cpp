#include "network/vmc/vmc_body.h"

#include <algorithm>
#include <string>

#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/avatar/humanoid_rest.h"
#include "assets/human_bones.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint8_t kNow = kJointValid | kJointTracked;
constexpr std::uint8_t kInferred = kJointValid | kJointInferred;
constexpr std::uint8_t kStale = kJointValid;

/// Unity's own body: its left, up and front.
Matrix3d unityFrame() {
  Matrix3d frame;
  frame << Vector3d(-1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1);
  return frame;
}

/// The mirror from Unity's world to ours, as FT_AXES_Y_UP_LEFT has it.
Matrix3d worldMirror() {
  return Vector3d(1, 1, -1).asDiagonal();
}

/// A rotation in mirrored axes.
Quaternion mirrored(const Matrix3d& mirror, const Quaternion& q) {
  const Vector3d axis = -(mirror * q.vec());
  return {q.w(), axis.x(), axis.y(), axis.z()};
}

bool isPlace(const Vector3d& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

}  // namespace

Result<VmcBody> VmcBody::make(std::int32_t avatar, const Skeleton& skeleton, VmcBones bones) {
  VmcBody body(avatar, skeleton);
  FORETOUCH_CHECK(body.settle(bones));
  return body;
}

Result<Done> VmcBody::settle(VmcBones bones) {
  const auto found = humanBonesOf(skeleton_);
  if (found.empty()) {
    return Error::of(ErrorCode::Mismatch,
                     "is no humanoid: expected joints with the names of the 15 bones that VRM "
                     "requires, such as 'hips' and 'leftUpperArm'");
  }
  const HumanoidRest rest(skeleton_, found);
  const Matrix3d frame = rest.frame();
  if (frame.isZero()) {
    return Error::of(ErrorCode::Mismatch, "does not stand along the axes at rest");
  }
  if (bones == VmcBones::Normalized) {
    if (const auto bent = rest.farthestFromTPose(); bent.tiltDeg > kMostTPoseTiltDeg) {
      return Error::of(ErrorCode::Mismatch, "does not rest in a T-pose: joint " +
                                                inQuotes(skeleton_.name(bent.joint)) + " is " +
                                                inDigits(bent.tiltDeg, 3) + " degrees off");
    }
  }
  fromUnity_ = frame * unityFrame().transpose();
  for (const auto& [name, joint] : found) joints_.push_back(joint);
  std::sort(joints_.begin(), joints_.end());
  for (const auto& [name, joint] : found) {
    const auto place = std::find(joints_.begin(), joints_.end(), joint);
    boneOf_[std::string(name)] = countOf(place - joints_.begin());
  }
  hips_ = boneOf_.at("hips");
  for (JointId up = skeleton_.parent(joints_[hips_]); up != kNoParent; up = skeleton_.parent(up)) {
    carriers_.insert(carriers_.begin(), up);
  }
  const bool isNormalized = bones == VmcBones::Normalized;
  if (isNormalized && !carriers_.empty()) hipsBase_ = rest.place(carriers_.back()).translation;
  for (const JointId joint : joints_) {
    const JointId parent = skeleton_.parent(joint);
    const Quaternion none = Quaternion::Identity();
    const Quaternion above = parent == kNoParent ? none : rest.place(parent).rotation;
    before_.push_back(isNormalized ? Quaternion(above.conjugate()) : none);
    after_.push_back(isNormalized ? rest.place(joint).rotation : none);
  }
  return Done{};
}

std::optional<std::size_t> VmcBody::boneOf(std::string_view unityName) const {
  const auto found = boneOf_.find(humanBoneOfUnity(unityName));
  return found == boneOf_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<bool> VmcBody::jointsOf(const std::vector<bool>& bones) const {
  std::vector<bool> joints(countOf(skeleton_.numJoints()), false);
  for (std::size_t i = 0; i < joints_.size(); ++i) joints[slotOf(joints_[i])] = bones[i];
  for (const JointId carrier : carriers_) joints[slotOf(carrier)] = true;
  return joints;
}

RawSkeleton VmcBody::skeletonOf(const std::vector<bool>& bones) const {
  const std::vector<bool> isIn = jointsOf(bones);
  std::vector<JointId> place(isIn.size(), kNoParent);
  RawSkeleton raw;
  for (JointId joint = 0; joint < skeleton_.numJoints(); ++joint) {
    if (!isIn[slotOf(joint)]) continue;
    JointId parent = skeleton_.parent(joint);
    while (parent != kNoParent && !isIn[slotOf(parent)]) parent = skeleton_.parent(parent);
    place[slotOf(joint)] = static_cast<JointId>(raw.joints.size());
    raw.joints.push_back({skeleton_.name(joint),
                          parent == kNoParent ? kNoParent : place[slotOf(parent)],
                          skeleton_.restOffset(joint), skeleton_.restRotation(joint)});
  }
  return raw;
}

/// The avatar's own world in ours: where the sender's model stands, which a mirror of its own
/// brought into the avatar's axes.
RigidPose VmcBody::placeOf(const RigidPose& root) const {
  const Matrix3d turn = worldMirror() * fromUnity_.transpose();
  return {mirrored(worldMirror(), root.rotation) * Quaternion(turn),
          worldMirror() * root.translation};
}

VmcBody::Said VmcBody::saidOf(JointId joint, std::optional<std::size_t> bone,
                              const VmcFrame& frame) const {
  const bool isRoot = skeleton_.parent(joint) == kNoParent;
  Said said{{skeleton_.restRotation(joint), skeleton_.restOffset(joint)}, kInferred, isRoot};
  if (bone) {
    const RigidPose& local = frame.bones[*bone];
    const bool isHips = *bone == hips_;
    const auto turn = unitQuaternion(local.rotation);
    if (!turn || (isHips && !isPlace(local.translation))) return {said.pose, 0, false};
    said.flags = frame.isTracked ? kNow : kStale;
    said.isPlaced = isRoot || isHips;
    said.pose.rotation = before_[*bone] * mirrored(fromUnity_, *turn) * after_[*bone];
    if (isHips) {
      said.pose.translation = before_[*bone] * (fromUnity_ * local.translation - hipsBase_);
    }
  }
  if (!isRoot) return said;
  if (!frame.isTracked || frame.isRootOld) said.flags = kStale;
  const auto turn = unitQuaternion(frame.root.rotation);
  if (!turn || !isPlace(frame.root.translation)) return {said.pose, 0, false};
  const RigidPose place = placeOf({*turn, frame.root.translation});
  said.pose.translation = place.translation + place.rotation * said.pose.translation;
  said.pose.rotation = place.rotation * said.pose.rotation;
  return said;
}

void VmcBody::fill(const std::vector<bool>& of, const VmcFrame& frame, PoseMessage& message) const {
  message.joints.clear();
  message.translations.clear();
  const std::vector<bool> isIn = jointsOf(of);
  std::int32_t index = -1;
  std::size_t next = 0;
  for (JointId joint = 0; joint < skeleton_.numJoints(); ++joint) {
    while (next < joints_.size() && joints_[next] < joint) ++next;
    if (!isIn[slotOf(joint)]) continue;
    ++index;
    const bool isBone = next < joints_.size() && joints_[next] == joint;
    if (isBone && !frame.has[next]) continue;
    Said said = saidOf(joint, isBone ? std::optional(next) : std::nullopt, frame);
    if (said.isPlaced && !isPlace(said.pose.translation)) said.flags = 0;
    message.joints.push_back({index, said.flags, said.pose.rotation.normalized()});
    if (said.isPlaced && said.flags != 0) {
      message.translations.push_back({index, said.pose.translation});
    }
  }
}

}  // namespace foretouch
