#include <bitset>
#include <cstddef>
#include <foretouch/pose_t.hpp>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

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

Reject readHead(const pose_t& wire, PoseMessage& message) {
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sequence = wire.sequence;
  message.utimeUs = wire.utime;
  message.sendUtimeUs = wire.send_utime;
  message.skeletonHash = wire.skeleton_hash;
  return inRange({wire.session, wire.sequence, wire.utime, wire.send_utime}) ? Reject::None
                                                                             : Reject::OutOfRange;
}

Reject readRotation(const pose_t& wire, std::size_t i, Quaternion& rotation) {
  rotation =
      Quaternion(wire.rotation_w[i], wire.rotation_x[i], wire.rotation_y[i], wire.rotation_z[i]);
  if (!rotation.coeffs().allFinite()) return Reject::NonFinite;
  return unitQuaternion(rotation) ? Reject::None : Reject::NonUnit;
}

Reject readJoints(const pose_t& wire, PoseMessage& message, JointSet& listed, JointSet& valid) {
  message.joints.resize(static_cast<std::size_t>(wire.num_joints));
  for (std::size_t i = 0; i < message.joints.size(); ++i) {
    PoseJoint& joint = message.joints[i];
    joint.joint = wire.joints[i];
    joint.flags = wire.flags[i];
    joint.rotation = Quaternion::Identity();
    if (!insert(joint.joint, listed)) return Reject::BadIndex;
    if ((joint.flags & ~kKnownFlags) != 0) return Reject::OutOfRange;
    if ((joint.flags & kJointValid) == 0) continue;
    valid.set(slotOf(joint.joint));
    const Reject reject = readRotation(wire, i, joint.rotation);
    if (reject != Reject::None) return reject;
  }
  return Reject::None;
}

Reject readTranslations(const pose_t& wire, PoseMessage& message, const JointSet& listed,
                        const JointSet& valid) {
  JointSet translated;
  message.translations.resize(static_cast<std::size_t>(wire.num_translations));
  for (std::size_t i = 0; i < message.translations.size(); ++i) {
    PoseTranslation& joint = message.translations[i];
    joint.joint = wire.translated_joints[i];
    joint.translation.setZero();
    if (!insert(joint.joint, translated)) return Reject::BadIndex;
    if (!listed[slotOf(joint.joint)]) return Reject::BadIndex;
    if (!valid[slotOf(joint.joint)]) continue;
    joint.translation = {wire.translation_x[i], wire.translation_y[i], wire.translation_z[i]};
    if (!joint.translation.allFinite()) return Reject::NonFinite;
    if (joint.translation.cwiseAbs().maxCoeff() > kMaxCoordinate) return Reject::OutOfRange;
  }
  return Reject::None;
}

void writeJoints(const PoseMessage& message, pose_t& wire) {
  const std::size_t n = message.joints.size();
  wire.num_joints = static_cast<std::int32_t>(n);
  wire.joints.resize(n);
  wire.flags.resize(n);
  for (auto* const part :
       {&wire.rotation_w, &wire.rotation_x, &wire.rotation_y, &wire.rotation_z}) {
    part->resize(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PoseJoint& joint = message.joints[i];
    wire.joints[i] = joint.joint;
    wire.flags[i] = joint.flags;
    wire.rotation_w[i] = joint.rotation.w();
    wire.rotation_x[i] = joint.rotation.x();
    wire.rotation_y[i] = joint.rotation.y();
    wire.rotation_z[i] = joint.rotation.z();
  }
}

void writeTranslations(const PoseMessage& message, pose_t& wire) {
  const std::size_t n = message.translations.size();
  wire.num_translations = static_cast<std::int32_t>(n);
  wire.translated_joints.resize(n);
  for (auto* const part : {&wire.translation_x, &wire.translation_y, &wire.translation_z}) {
    part->resize(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const PoseTranslation& joint = message.translations[i];
    wire.translated_joints[i] = joint.joint;
    wire.translation_x[i] = joint.translation.x();
    wire.translation_y[i] = joint.translation.y();
    wire.translation_z[i] = joint.translation.z();
  }
}

/// Keeps its memory: a stream has a hundred poses per second.
pose_t& scratch() {
  static thread_local pose_t wire;
  return wire;
}

}  // namespace

Reject decode(ByteView payload, PoseMessage& message) {
  pose_t& wire = scratch();
  Reject reject = fromBytes(PayloadType::Pose, payload, wire);
  if (reject == Reject::None) reject = readHead(wire, message);
  JointSet listed, valid;
  if (reject == Reject::None) reject = readJoints(wire, message, listed, valid);
  if (reject == Reject::None) reject = readTranslations(wire, message, listed, valid);
  return reject;
}

void encode(const PoseMessage& message, Bytes& payload) {
  pose_t& wire = scratch();
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.sequence = message.sequence;
  wire.utime = message.utimeUs;
  wire.send_utime = message.sendUtimeUs;
  wire.skeleton_hash = message.skeletonHash;
  writeJoints(message, wire);
  writeTranslations(message, wire);
  toBytes(PayloadType::Pose, wire, payload);
}

}  // namespace foretouch
