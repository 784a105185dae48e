// middleware/events/swept_tube.h: what an LSS sweeps in a span of its motion, as one LSS that holds
// it: boxes around limbs that lie askew hold many times as much. Not installed.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "lss/closest_features.h"
#include "lss/lss.h"
#include "lss/rounding.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// Around the axis half-way between its places at both ends of the span. A point of the axis stays
/// as near to its place there as the farther one of the axis' ends does: half of that end's chord,
/// and what its path bends (guarantees.md 4).
class SweptTube {
 public:
  /// As sweptBox().
  SweptTube(const Lss& lss_L, const AxisBounds& bounds, const AxisEnds& begin, const AxisEnds& end,
            double span, double margin)
      : a_(0.5 * (begin.a + end.a)), axis_(0.5 * (begin.b + end.b) - a_) {
    const double sagitta = span * span / 8.0;
    const double strayA =
        0.5 * (end.a - begin.a).norm() + bounds.accelerationA * sagitta + bounds.positionRoundingA;
    const double strayB =
        0.5 * (end.b - begin.b).norm() + bounds.accelerationB * sagitta + bounds.positionRoundingB;
    reach_ = lss_L.radius + margin + std::max(strayA, strayB);
    const double squared = axis_.squaredNorm();
    perSquare_ = squared > 0.0 ? 1.0 / squared : 0.0;
    extent_ = a_.lpNorm<1>() + axis_.lpNorm<1>();
  }

  /// False: no point of the triangle is in the tube, rounding included. By a ball around the
  /// triangle.
  [[nodiscard]] bool mayMeet(const Triangle& triangle) const {
    const auto& [u, v, w] = triangle.vertices;
    const Eigen::Vector3d centre = (u + v + w) * (1.0 / 3.0);
    const double squaredRadius = std::max(
        {(u - centre).squaredNorm(), (v - centre).squaredNorm(), (w - centre).squaredNorm()});
    const Eigen::Vector3d from = centre - a_;
    const double s = clamp01(from.dot(axis_) * perSquare_);
    const double distance = (from - s * axis_).norm();
    const double most = (reach_ + std::sqrt(squaredRadius)) * kInflation;
    return distance <= most + kTubeRounding * (extent_ + centre.lpNorm<1>());
  }

 private:
  /// Roundings of the points, of the closest place on the axis and of the norm, relative to the
  /// coordinates involved: fewer than 32 of them.
  static constexpr double kTubeRounding = 32.0 * kUnitRoundoff;

  Eigen::Vector3d a_, axis_;
  double reach_ = 0.0, perSquare_ = 0.0, extent_ = 0.0;
};

}  // namespace foretouch::internal
