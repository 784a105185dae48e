#include <algorithm>
#include <cstddef>
#include <foretouch/skeleton_t.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"

namespace foretouch {
namespace {

Reject checkHead(const skeleton_t& wire) {
  if (wire.num_joints < 1) return Reject::Limit;  // a skeleton needs joints
  if (!inRange({wire.session, wire.send_utime, wire.generation})) return Reject::OutOfRange;
  if (!allFinite({wire.rate})) return Reject::NonFinite;
  return wire.rate >= 0.0 ? Reject::None : Reject::OutOfRange;
}

/// By sorting: crafted names could collide in a hash table.
Reject checkNames(const RawSkeleton& skeleton) {
  std::vector<std::string_view> names;
  names.reserve(skeleton.joints.size());
  for (const RawJoint& joint : skeleton.joints) {
    if (nameProblem(joint.name)) return Reject::BadName;
    names.push_back(joint.name);
  }
  std::sort(names.begin(), names.end());
  const bool unique = std::adjacent_find(names.begin(), names.end()) == names.end();
  return unique ? Reject::None : Reject::BadName;
}

Reject checkParents(const RawSkeleton& skeleton) {
  const auto numJoints = static_cast<JointId>(skeleton.joints.size());
  std::vector<std::int32_t> depth(skeleton.joints.size(), 1);
  for (JointId j = 0; j < numJoints; ++j) {
    const JointId parent = skeleton.joints[slotOf(j)].parent;
    if (parent == kNoParent) continue;
    if (parent < 0 || parent >= numJoints) return Reject::BadIndex;
    if (parent >= j) return Reject::BadHierarchy;
    std::int32_t& own = depth[slotOf(j)];
    own = depth[slotOf(parent)] + 1;
    if (own > kMaxChainDepth) return Reject::Limit;
  }
  return Reject::None;
}

Reject checkRestPose(const RawJoint& joint) {
  if (!joint.offset.allFinite() || !joint.rotation.coeffs().allFinite()) return Reject::NonFinite;
  if (joint.offset.cwiseAbs().maxCoeff() > kMaxCoordinate) return Reject::OutOfRange;
  return unitQuaternion(joint.rotation) ? Reject::None : Reject::NonUnit;
}

Reject checkSkeleton(const RawSkeleton& skeleton) {
  Reject reject = checkNames(skeleton);
  if (reject == Reject::None) reject = checkParents(skeleton);
  for (std::size_t i = 0; i < skeleton.joints.size() && reject == Reject::None; ++i) {
    reject = checkRestPose(skeleton.joints[i]);
  }
  return reject;
}

RawSkeleton skeletonOf(skeleton_t& wire) {
  RawSkeleton skeleton;
  skeleton.joints.resize(static_cast<std::size_t>(wire.num_joints));
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    RawJoint& joint = skeleton.joints[i];
    joint.name = std::move(wire.names[i]);
    joint.parent = wire.parents[i];
    joint.offset = {wire.offset_x[i], wire.offset_y[i], wire.offset_z[i]};
    joint.rotation =
        Quaternion(wire.rotation_w[i], wire.rotation_x[i], wire.rotation_y[i], wire.rotation_z[i]);
  }
  return skeleton;
}

void appendJoint(const RawJoint& joint, skeleton_t& wire) {
  wire.names.push_back(joint.name);
  wire.parents.push_back(joint.parent);
  wire.offset_x.push_back(joint.offset.x());
  wire.offset_y.push_back(joint.offset.y());
  wire.offset_z.push_back(joint.offset.z());
  wire.rotation_w.push_back(joint.rotation.w());
  wire.rotation_x.push_back(joint.rotation.x());
  wire.rotation_y.push_back(joint.rotation.y());
  wire.rotation_z.push_back(joint.rotation.z());
}

}  // namespace

Reject decode(ByteView payload, SkeletonMessage& message) {
  skeleton_t wire;
  Reject reject = fromBytes(PayloadType::Skeleton, payload, wire);
  if (reject == Reject::None) reject = checkHead(wire);
  if (reject != Reject::None) return reject;
  message.avatar = wire.avatar;
  message.session = wire.session;
  message.sendUtimeUs = wire.send_utime;
  message.generation = wire.generation;
  message.hash = wire.hash;
  message.source = wire.source;
  message.rateHz = wire.rate;
  message.skeleton = skeletonOf(wire);
  reject = checkSkeleton(message.skeleton);
  if (reject != Reject::None) return reject;
  return skeletonHash(message.skeleton) == message.hash ? Reject::None : Reject::BadHash;
}

void encode(const SkeletonMessage& message, Bytes& payload) {
  skeleton_t wire;
  wire.version = kMessageVersion;
  wire.avatar = message.avatar;
  wire.session = message.session;
  wire.send_utime = message.sendUtimeUs;
  wire.generation = message.generation;
  wire.hash = message.hash;
  wire.source = message.source;
  wire.rate = message.rateHz;
  wire.num_joints = static_cast<std::int32_t>(message.skeleton.joints.size());
  for (const RawJoint& joint : message.skeleton.joints) appendJoint(joint, wire);
  toBytes(PayloadType::Skeleton, wire, payload);
}

}  // namespace foretouch
