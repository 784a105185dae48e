#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "lss/index.h"
#include "network/wire/codec.h"
#include "network/wire/codec_lcm.h"
#include "network/wire/message_fields.h"

namespace foretouch {
namespace {

/// By sorting: crafted names could collide in a hash table.
Reject checkNames(const RawSkeleton& skeleton) {
  std::vector<std::string_view> names;
  names.reserve(skeleton.joints.size());
  for (const RawJoint& joint : skeleton.joints) {
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

}  // namespace

Reject decode(ByteView payload, SkeletonMessage& message) {
  skeleton_t wire;
  Reject reject = fromBytes(PayloadType::Skeleton, payload, wire);
  if (reject != Reject::None) return reject;
  if (wire.num_joints < 1) return Reject::Limit;  // a skeleton needs joints
  reject = wire::read(wire, wire::kSkeleton, message);
  if (reject != Reject::None) return reject;
  RawSkeleton& skeleton = message.skeleton;
  reject = wire::readRows(wire, wire::kSkeletonJoint, &skeleton_t::num_joints, skeleton.joints,
                          wire::kAnyRow);
  if (reject == Reject::None) reject = checkNames(skeleton);
  if (reject == Reject::None) reject = checkParents(skeleton);
  if (reject != Reject::None) return reject;
  return skeletonHash(skeleton) == message.hash ? Reject::None : Reject::BadHash;
}

void encode(const SkeletonMessage& message, Bytes& payload) {
  skeleton_t wire;
  wire::write(message, wire::kSkeleton, wire);
  wire::writeRows(message.skeleton.joints, wire::kSkeletonJoint, &skeleton_t::num_joints, wire);
  toBytes(PayloadType::Skeleton, wire, payload);
}

}  // namespace foretouch
