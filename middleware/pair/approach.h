// middleware/pair/approach.h: how fast two points meet, with a proven bracket. Not installed.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "lss/rounding.h"

namespace foretouch::internal {

/// A point that moves with a link at one instant, and bounds on its motion from then on.
struct MaterialPoint {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  double acceleration = 0.0, velocityRounding = 0.0;
};

/// The point of a link that is at `p` then; state and bounds in the same frame.
[[nodiscard]] inline MaterialPoint materialPointAt(const LinkState& state,
                                                   const MotionBounds& bounds,
                                                   const Eigen::Vector3d& p) {
  const double rho = (p - state.p_WL).norm() * kInflation + bounds.originRounding;
  return {state.velocityOf(p), bounds.accelerationAt(rho), bounds.velocityRoundingAt(rho)};
}

struct Approach {
  double speed = 0.0, lower = 0.0, upper = 0.0;
};

/// Along a fixed normal the speed changes by no more than both accelerations; the gap, the
/// contact's separation, is closed by the root of its quadratic if it has one. `rest`: for how long
/// the bounds hold.
[[nodiscard]] inline Approach approachAlong(const Eigen::Vector3d& nhat, double separation,
                                            const MaterialPoint& one, const MaterialPoint& other,
                                            double rest) {
  const double speed = -nhat.dot(one.velocity - other.velocity);
  const double acceleration = one.acceleration + other.acceleration;
  double within = rest;
  const double square = speed * speed - 2.0 * acceleration * separation;
  if (speed > 0.0 && square >= 0.0) {
    // The first instant at which the slowest such approach has closed the gap.
    within = std::min(within, 2.0 * separation / (speed + std::sqrt(square)));
  }
  const double change =
      (acceleration * within + one.velocityRounding + other.velocityRounding) * kInflation;
  return {speed, speed - change, speed + change};
}

}  // namespace foretouch::internal
