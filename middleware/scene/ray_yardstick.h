// middleware/scene/ray_yardstick.h: the cost of a ray in the same scene and process. Absolute times
// drift on shared machines; times in ray sets do not. Rays decide nothing here: Embree's are float.
#pragma once

#include <array>

#include <Eigen/Core>

#include "articulated/result.h"
#include "middleware/scene/scene.h"

namespace foretouch {

/// Rays per set.
inline constexpr int kRaysPerSet = 16;

struct RaySegment {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< W, metres.
};

/// Not where this library was built without Embree.
[[nodiscard]] bool canCastRays();

/// Casts the set with rtcOccluded1, one ray at a time, and counts the rays that hit something.
/// The first call builds the scene's ray structures; do not time that one. Errors: DeviceFailed,
/// also where this library was built without Embree.
[[nodiscard]] Result<int> castRaySet(const Scene& scene,
                                     const std::array<RaySegment, kRaysPerSet>& rays);

}  // namespace foretouch
