#include <bitset>
#include <cstddef>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

namespace foretouch {
namespace {

/// Joints of a message, by index.
using JointSet = std::bitset<countOf(kMaxJoints)>;

/// False if no skeleton can have this joint, or if it is in `joints` already.
bool insert(std::int32_t joint, JointSet& joints) {
  if (joint < 0 || joint >= kMaxJoints || joints[slotOf(joint)]) return false;
  joints.set(slotOf(joint));
  return true;
}

}  // namespace

Reject decode(ByteView payload, PoseMessage& message) {
  auto& wire = wire::scratch<pose_t>();
  Reject reject = fromBytes(PayloadType::Pose, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, wire::kPose, message);
  if (reject != Reject::None) return reject;
  JointSet listed, valid, translated;
  const auto readRotation = [&](PoseJoint& joint, std::size_t i) {
    if (!insert(joint.joint, listed)) return Reject::BadIndex;
    joint.rotation = Quaternion::Identity();
    if ((joint.flags & kJointValid) == 0) return Reject::None;
    valid.set(slotOf(joint.joint));
    return wire::read(wire, wire::kPoseRotation, joint, i);
  };
  const auto readTranslation = [&](PoseTranslation& joint, std::size_t i) {
    if (!insert(joint.joint, translated)) return Reject::BadIndex;
    if (!listed[slotOf(joint.joint)]) return Reject::BadIndex;
    joint.translation.setZero();
    return valid[slotOf(joint.joint)] ? wire::read(wire, wire::kMovedPlace, joint, i)
                                      : Reject::None;
  };
  reject =
      wire::readRows(wire, wire::kPoseJoint, &pose_t::num_joints, message.joints, readRotation);
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, wire::kMovedJoint, &pose_t::num_translations, message.translations,
                        readTranslation);
}

void encode(const PoseMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<pose_t>();
  wire::write(message, wire::kPose, wire);
  wire::writeRows(message.joints, std::tuple_cat(wire::kPoseJoint, wire::kPoseRotation),
                  &pose_t::num_joints, wire);
  wire::writeRows(message.translations, std::tuple_cat(wire::kMovedJoint, wire::kMovedPlace),
                  &pose_t::num_translations, wire);
  toBytes(PayloadType::Pose, wire, payload);
}

}  // namespace foretouch
