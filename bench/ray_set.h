// bench/ray_set.h: the rays that latencies are compared to: the cost of a ray in the same scene and
// process. Absolute times drift on shared machines; times in ray sets do not. Rays decide nothing
// here: Embree's are float.
#pragma once

#include <array>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/result.h"
#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Rays per set.
inline constexpr int kRaysPerSet = 16;

struct RaySegment {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< W, metres.
};

/// Each is the way of one link's origin from pose to pose, the line of a ray cast between the
/// poses. Repeats links if there are fewer than rays; takes the first ones if there are more.
[[nodiscard]] std::array<RaySegment, kRaysPerSet> raysAlong(const ChainMotion& motion);

/// Casts the set with rtcOccluded1, one ray at a time, and counts the rays that hit something. The
/// first call builds the scene's ray structures; do not time that one. Errors: DeviceFailed, also
/// in a build without Embree.
[[nodiscard]] Result<int> castRaySet(const Scene& scene,
                                     const std::array<RaySegment, kRaysPerSet>& rays);

}  // namespace foretouch::tools
