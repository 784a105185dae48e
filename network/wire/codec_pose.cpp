#include <bitset>
#include <cstddef>
#include <foretouch/pose_t.hpp>
#include <tuple>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/wire_fields.h"

namespace foretouch {
namespace {

constexpr int kKnownFlags = kJointValid | kJointTracked | kJointInferred;

/// Joints of a message, by index.
using JointSet = std::bitset<countOf(kMaxJoints)>;

/// False if no skeleton can have this joint, or if it is in `joints` already.
bool insert(std::int32_t joint, JointSet& joints) {
  if (joint < 0 || joint >= kMaxJoints || joints[slotOf(joint)]) return false;
  joints.set(slotOf(joint));
  return true;
}

using wire::field;

constexpr auto kPoseHead =
    std::make_tuple(field(&PoseMessage::avatar, &pose_t::avatar, wire::kAny),
                    field(&PoseMessage::session, &pose_t::session, wire::kWhole),
                    field(&PoseMessage::sequence, &pose_t::sequence, wire::kWhole),
                    field(&PoseMessage::utimeUs, &pose_t::utime, wire::kWhole),
                    field(&PoseMessage::sendUtimeUs, &pose_t::send_utime, wire::kWhole),
                    field(&PoseMessage::skeletonHash, &pose_t::skeleton_hash, wire::kAny));

constexpr auto kJointNumber =
    std::make_tuple(field(&PoseJoint::joint, &pose_t::joints, wire::kAny),
                    field(&PoseJoint::flags, &pose_t::flags, wire::Whole{0, kKnownFlags}));
constexpr auto kTranslatedNumber =
    std::make_tuple(field(&PoseTranslation::joint, &pose_t::translated_joints, wire::kAny));
/// Meaningless unless kJointValid.
constexpr auto kRotation =
    std::make_tuple(field(&PoseJoint::rotation, &pose_t::rotation_w, &pose_t::rotation_x,
                          &pose_t::rotation_y, &pose_t::rotation_z, wire::kTurn));
constexpr auto kTranslation =
    std::make_tuple(field(&PoseTranslation::translation, &pose_t::translation_x,
                          &pose_t::translation_y, &pose_t::translation_z, wire::kCoordinate));

}  // namespace

Reject decode(ByteView payload, PoseMessage& message) {
  auto& wire = wire::scratch<pose_t>();
  Reject reject = fromBytes(PayloadType::Pose, payload, wire);
  if (reject == Reject::None) reject = wire::read(wire, kPoseHead, message);
  if (reject != Reject::None) return reject;
  JointSet listed, valid, translated;
  const auto readRotation = [&](PoseJoint& joint, std::size_t i) {
    if (!insert(joint.joint, listed)) return Reject::BadIndex;
    joint.rotation = Quaternion::Identity();
    if ((joint.flags & kJointValid) == 0) return Reject::None;
    valid.set(slotOf(joint.joint));
    return wire::read(wire, kRotation, joint, i);
  };
  const auto readTranslation = [&](PoseTranslation& joint, std::size_t i) {
    if (!insert(joint.joint, translated)) return Reject::BadIndex;
    if (!listed[slotOf(joint.joint)]) return Reject::BadIndex;
    joint.translation.setZero();
    return valid[slotOf(joint.joint)] ? wire::read(wire, kTranslation, joint, i) : Reject::None;
  };
  reject = wire::readRows(wire, kJointNumber, &pose_t::num_joints, message.joints, readRotation);
  if (reject != Reject::None) return reject;
  return wire::readRows(wire, kTranslatedNumber, &pose_t::num_translations, message.translations,
                        readTranslation);
}

void encode(const PoseMessage& message, Bytes& payload) {
  auto& wire = wire::scratch<pose_t>();
  wire::write(message, kPoseHead, wire);
  wire::writeRows(message.joints, std::tuple_cat(kJointNumber, kRotation), &pose_t::num_joints,
                  wire);
  wire::writeRows(message.translations, std::tuple_cat(kTranslatedNumber, kTranslation),
                  &pose_t::num_translations, wire);
  toBytes(PayloadType::Pose, wire, payload);
}

}  // namespace foretouch
