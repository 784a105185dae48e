// tests/network/small_stream.h: an avatar of four joints and its sender's messages.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "middleware/scene/scene.h"
#include "network/wire/messages.h"

namespace foretouch::test {

inline constexpr std::int64_t kStepUs = 10'000;
inline constexpr std::uint8_t kTrackedNow = kJointValid | kJointTracked;

/// Hips with an arm, a hand on it and a leg.
inline RawSkeleton smallSkeleton() {
  RawSkeleton raw;
  raw.joints.push_back({"Hips", kNoParent, {0.0, 1.0, 0.0}, Quaternion::Identity()});
  raw.joints.push_back({"Arm", 0, {0.2, 0.3, 0.0}, Quaternion(0.6, 0.8, 0.0, 0.0)});
  raw.joints.push_back({"Hand", 1, {0.0, 0.4, 0.0}, Quaternion::Identity()});
  raw.joints.push_back({"Leg", 0, {0.1, -0.1, 0.0}, Quaternion::Identity()});
  return raw;
}

enum SmallJoint : JointId { kHips = 0, kArm = 1, kHand = 2, kLeg = 3 };

inline Avatar smallAvatar() {
  const Lss bone{{0.0, 0.0, 0.0}, {0.0, 0.3, 0.0}, 0.05};
  return Avatar::build(Skeleton::build(smallSkeleton()).value(), {{bone}, {bone}, {bone}, {bone}})
      .value();
}

/// A wall across x = 1.
inline Scene farWall() {
  RawScene raw;
  raw.objectNames = {"wall"};
  const Eigen::Vector3d a(1.0, -5.0, -5.0), b(1.0, 9.0, -5.0), c(1.0, 0.0, 9.0);
  raw.triangles.push_back(Triangle{{a, b, c}});
  raw.objectOf = {0};
  return Scene::build(raw).value();
}

inline SkeletonMessage skeletonMessage(const RawSkeleton& skeleton, std::int64_t session = 1,
                                       std::int32_t generation = 0) {
  SkeletonMessage message;
  message.session = session;
  message.generation = generation;
  message.skeleton = skeleton;
  message.hash = skeletonHash(skeleton);
  return message;
}

/// Every joint at rest and tracked, and the place of the hips.
inline PoseMessage poseMessage(const RawSkeleton& skeleton, std::int64_t sequence,
                               std::int64_t utimeUs, std::int64_t session = 1) {
  PoseMessage message;
  message.session = session;
  message.sequence = sequence;
  message.utimeUs = utimeUs;
  message.skeletonHash = skeletonHash(skeleton);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    message.joints.push_back(
        {static_cast<std::int32_t>(j), kTrackedNow, skeleton.joints[j].rotation});
  }
  message.translations.push_back({0, skeleton.joints.front().offset});
  return message;
}

/// The nth of a stream that keeps every rule.
inline PoseMessage nthPose(std::int64_t n, std::int64_t session = 1) {
  return poseMessage(smallSkeleton(), n, n * kStepUs, session);
}

/// The same, with the hips at (x, 1, 0).
inline PoseMessage hipsAt(double x, std::int64_t n, std::int64_t session = 1) {
  PoseMessage message = nthPose(n, session);
  message.translations[0].translation = {x, 1.0, 0.0};
  return message;
}

}  // namespace foretouch::test
