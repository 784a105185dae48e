// middleware/events/swept_tube.h: what an LSS sweeps in a span of its motion, as one LSS that holds
// it: boxes around limbs that lie askew hold many times as much. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "lss/closest_features.h"
#include "lss/lss.h"
#include "lss/rounding.h"
#include "lss/separation.h"
#include "tessellation/aabb.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// A tube around the axis half-way between its places at both ends of the span. A point of the axis
/// stays as near to its place there as the farther one of the axis' ends does: half of that end's
/// chord, and what its path bends (guarantees.md 4).
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
  [[nodiscard]] bool mayMeet(const Triangle& triangle) const { return mayMeet(ballOf(triangle)); }

  struct Ball {
    Eigen::Vector3d centre;
    double radius;
  };
  [[nodiscard]] bool mayMeet(const Ball& ball) const { return isNear(ball, distanceTo(ball)); }
  /// How far its centre is from the tube's axis, as computed.
  [[nodiscard]] double distanceTo(const Ball& ball) const {
    const Eigen::Vector3d from = ball.centre - a_;
    const double s = clamp01(from.dot(axis_) * perSquare_);
    return (from - s * axis_).norm();
  }
  /// Its axis, and how far from there it reaches; rounded outward. Nothing: it holds no point.
  [[nodiscard]] AxisEnds axis() const { return {a_, a_ + axis_}; }
  [[nodiscard]] double reach() const { return reach_ * kInflation + kTubeRounding * extent_; }
  [[nodiscard]] bool isNothing() const { return !(reach() >= 0.0); }
  /// Holds the tube; rounds outward.
  [[nodiscard]] Aabb box() const {
    Aabb box;
    box.add(a_);
    box.add(Eigen::Vector3d(a_ + axis_));
    box.grow(reach());
    return box;
  }
  /// Nothing: no point of the triangle is in the tube. Else about how far it is from the tube's
  /// axis, or its ball's centre is: a triangle whose ball is thicker than the tube is looked at
  /// itself.
  [[nodiscard]] std::optional<double> distanceTo(const Triangle& triangle) const {
    const Ball ball = ballOf(triangle);
    const double fromBall = distanceTo(ball);
    if (!isNear(ball, fromBall)) return std::nullopt;
    if (ball.radius <= reach_) return fromBall;
    const double extent = extent_ + ball.centre.lpNorm<1>() + 2.0 * ball.radius;
    const double most = reach_ * kInflation + kTubeRounding * extent;
    if (apartAlongNormals(triangle) > most) return std::nullopt;
    const Separation apart = separation(Hull::segment(a_, a_ + axis_), Hull::of(triangle));
    if (apart.lower() > most) return std::nullopt;
    return apart.distance;
  }

 private:
  /// Roundings of the points, of the closest place on the axis and of the norm, relative to the
  /// coordinates involved: fewer than 32 of them.
  static constexpr double kTubeRounding = 32.0 * kUnitRoundoff;

  [[nodiscard]] bool isNear(const Ball& ball, double distance) const {
    const double most = (reach_ + ball.radius) * kInflation;
    return distance <= most + kTubeRounding * (extent_ + ball.centre.lpNorm<1>());
  }
  [[nodiscard]] static Ball ballOf(const Triangle& triangle) {
    const auto& [u, v, w] = triangle.vertices;
    const Eigen::Vector3d centre = (u + v + w) * (1.0 / 3.0);
    return {centre, std::sqrt(std::max({(u - centre).squaredNorm(), (v - centre).squaredNorm(),
                                        (w - centre).squaredNorm()}))};
  }

  /// How far the axis and the triangle are apart along the triangle's normal, or along that of an
  /// edge in its plane, as computed: never more than they are. Whatever those directions are, to
  /// rounding: all corners are looked at.
  [[nodiscard]] double apartAlongNormals(const Triangle& triangle) const {
    const auto& [u, v, w] = triangle.vertices;
    const std::array<Eigen::Vector3d, 3> corners{u - a_, v - a_, w - a_};
    const Eigen::Vector3d normal = (v - u).cross(w - u);
    double most = apartAlong(normal, corners);
    for (std::size_t i = 0; i < 3; ++i) {
      most = std::max(most, apartAlong((corners[(i + 1) % 3] - corners[i]).cross(normal), corners));
    }
    return most;
  }
  /// Corners from a_; not above 0 if they are not.
  [[nodiscard]] double apartAlong(const Eigen::Vector3d& direction,
                                  const std::array<Eigen::Vector3d, 3>& corners) const {
    const double u = direction.dot(corners[0]), v = direction.dot(corners[1]);
    const double w = direction.dot(corners[2]), end = direction.dot(axis_);
    const double gap = std::max(std::min({u, v, w}) - std::max(0.0, end),
                                std::min(0.0, end) - std::max({u, v, w}));
    const double squared = direction.squaredNorm();
    return gap > 0.0 && squared > 0.0 ? gap / std::sqrt(squared) : 0.0;
  }

  Eigen::Vector3d a_, axis_;
  double reach_ = 0.0, perSquare_ = 0.0, extent_ = 0.0;
};

}  // namespace foretouch::internal
