#include "network/stream/pose_assembly.h"

#include <algorithm>
#include <utility>

#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr std::int32_t kNowhere = -1;

/// The joint's entry in `places`; null if the skeleton does not have it.
std::int32_t* placeOf(std::vector<std::int32_t>& places, std::int32_t joint) {
  if (joint < 0 || slotOf(joint) >= places.size()) return nullptr;
  return &places[slotOf(joint)];
}

}  // namespace

void findUnknownLinks(const Skeleton& skeleton, const std::vector<UndecidedReason>& from,
                      const std::vector<UndecidedReason>& to,
                      std::vector<UndecidedReason>& reasons) {
  reasons.resize(from.size());
  for (std::size_t link = 0; link < reasons.size(); ++link) {  // parents come first
    UndecidedReason reason = to[link] != UndecidedReason::None ? to[link] : from[link];
    const JointId parent = skeleton.parents()[link];
    if (reason == UndecidedReason::None && parent != kNoParent) {
      reason = reasons[slotOf(parent)];
    }
    reasons[link] = reason;
  }
}

PoseAssembly::PoseAssembly(const Skeleton& avatar, bool unmatchedAtRest)
    : avatar_(avatar), unmatchedAtRest_(unmatchedAtRest) {}

void PoseAssembly::use(const JointMatch& match, std::int32_t numSenderJoints) {
  const auto n = static_cast<std::size_t>(numSenderJoints);
  senderJointOf_ = match.clipJointOf;
  listed_.assign(n, kNowhere);
  translated_.assign(n, kNowhere);
  isTranslated_.assign(n, 0);
  later_.pose = restPose(avatar_);
  later_.reasons.assign(senderJointOf_.size(), UndecidedReason::MissingJoint);
  earlier_ = later_;
}

Reject PoseAssembly::check(const PoseMessage& message) {
  const Reject joints = checkJoints(message);
  return joints != Reject::None ? joints : checkTranslations(message);
}

Reject PoseAssembly::checkJoints(const PoseMessage& message) {
  std::fill(listed_.begin(), listed_.end(), kNowhere);
  for (std::size_t i = 0; i < message.joints.size(); ++i) {
    const PoseJoint& joint = message.joints[i];
    std::int32_t* const place = placeOf(listed_, joint.joint);
    if (place == nullptr || *place != kNowhere) return Reject::BadIndex;
    *place = static_cast<std::int32_t>(i);
    if ((joint.flags & ~kKnownJointFlags) != 0) return Reject::OutOfRange;
    if ((joint.flags & kJointValid) == 0) continue;
    if (!joint.rotation.coeffs().allFinite()) return Reject::NonFinite;
    if (!unitQuaternion(joint.rotation)) return Reject::NonUnit;
  }
  return Reject::None;
}

Reject PoseAssembly::checkTranslations(const PoseMessage& message) {
  std::fill(translated_.begin(), translated_.end(), kNowhere);
  for (std::size_t i = 0; i < message.translations.size(); ++i) {
    const PoseTranslation& given = message.translations[i];
    std::int32_t* const place = placeOf(translated_, given.joint);
    if (place == nullptr || *place != kNowhere) return Reject::BadIndex;
    *place = static_cast<std::int32_t>(i);
    const std::int32_t listed = listed_[slotOf(given.joint)];
    if (listed == kNowhere) return Reject::BadIndex;
    if ((message.joints[slotOf(listed)].flags & kJointValid) == 0) continue;
    if (!given.translation.allFinite()) return Reject::NonFinite;
    if (given.translation.cwiseAbs().maxCoeff() > kMaxCoordinate) return Reject::OutOfRange;
  }
  return Reject::None;
}

void PoseAssembly::assemble(const PoseMessage& message, bool isSession) {
  if (isSession) std::fill(isTranslated_.begin(), isTranslated_.end(), std::uint8_t{0});
  std::swap(earlier_, later_);
  for (std::size_t joint = 0; joint < senderJointOf_.size(); ++joint) {
    assembleJoint(joint, message);
  }
}

void PoseAssembly::assembleJoint(std::size_t joint, const PoseMessage& message) {
  later_.pose.rotations[joint] = earlier_.pose.rotations[joint];
  later_.pose.translations[joint] = earlier_.pose.translations[joint];
  UndecidedReason& reason = later_.reasons[joint];
  if (senderJointOf_[joint] == kNoParent) {  // rest values since use()
    reason = unmatchedAtRest_ ? UndecidedReason::None : UndecidedReason::UnmatchedJoint;
    return;
  }
  const auto sender = static_cast<std::size_t>(senderJointOf_[joint]);
  reason = reasonOf(sender, message);
  if (reason != UndecidedReason::None) return;
  const auto& listed = message.joints[slotOf(listed_[sender])];
  const auto unit = unitQuaternion(listed.rotation);
  FORETOUCH_ASSERT(unit.has_value());
  later_.pose.rotations[joint] = *unit;
  if (translated_[sender] == kNowhere) {
    later_.pose.translations[joint] = avatar_.restOffset(static_cast<JointId>(joint));
    return;
  }
  later_.pose.translations[joint] = message.translations[slotOf(translated_[sender])].translation;
  if (isTranslated_[sender] == 0 && earlier_.reasons[joint] == UndecidedReason::None) {
    earlier_.reasons[joint] = UndecidedReason::MissingJoint;
  }
  isTranslated_[sender] = 1;
}

UndecidedReason PoseAssembly::reasonOf(std::size_t sender, const PoseMessage& message) const {
  if (listed_[sender] == kNowhere) return UndecidedReason::MissingJoint;
  const std::uint8_t flags = message.joints[slotOf(listed_[sender])].flags;
  if ((flags & kJointValid) == 0) return UndecidedReason::InvalidJoint;
  if ((flags & (kJointTracked | kJointInferred)) == 0) return UndecidedReason::StaleJoint;
  const bool lacksTranslation = translated_[sender] == kNowhere && isTranslated_[sender] != 0;
  return lacksTranslation ? UndecidedReason::MissingJoint : UndecidedReason::None;
}

}  // namespace foretouch::internal
