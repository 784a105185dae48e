// lss/fit.h: an LSS that contains a set of points.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch {

enum class FitEffort : std::uint8_t {
  Thorough,  ///< For an avatar's own LSS.
  Quick,     ///< For the many nodes of a hierarchy: the principal axes, few steps across each.
};

/// An LSS that contains every point, rounding included (the radius is rounded up; a test owns
/// this). Small rather than smallest: the best by volume of a few axis directions (principal axes,
/// coordinate axes, the farthest pair found by two sweeps), each with a near-minimal enclosing
/// circle across. Precondition: `points` is not empty and finite (asserted). O(points).
[[nodiscard]] Lss fitLss(const std::vector<Eigen::Vector3d>& points,
                         FitEffort effort = FitEffort::Thorough);

/// Widens the LSS if needed so that it contains the point, rounding included.
void growToContain(Lss& lss, const Eigen::Vector3d& point);

/// Distance of a point to the LSS's axis, metres.
[[nodiscard]] double axisDistance(const Lss& lss, const Eigen::Vector3d& point);

/// How far a triangle sticks out of an LSS, metres, as rounded; negative: how deep it is inside.
[[nodiscard]] double sticksOut(const Lss& lss, const Triangle& triangle);

}  // namespace foretouch
