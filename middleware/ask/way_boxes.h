// middleware/ask/way_boxes.h: how near a shape can come to a box, by its own box: along its way, or
// at rest. Lower bounds, rounding included. Metres. Not installed.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "middleware/ask/asked_shape.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

inline constexpr double kBeyondReach = std::numeric_limits<double>::infinity();

/// Boxes are given relative to `origin`; none of their coordinates is above `extent`, but for those
/// of empty boxes, which are beyond reach.
class WayBoxes {
 public:
  WayBoxes(const AskedShape& shape, const Eigen::Vector3d& origin, double extent);

  /// The shape touches nothing in the box before it has moved so far; at rest, nothing there is
  /// nearer. kBeyondReach: it touches nothing there at all.
  [[nodiscard]] double nearest(const Aabb& box) const;
  /// The same for `count` boxes, coordinate by coordinate.
  template <typename Real>
  void nearest(int count, const Real* const (&lower)[3], const Real* const (&upper)[3],
               double* bounds) const {
    if (moves_) {
      alongWay(count, lower, upper, bounds);
    } else {
      atRest(count, lower, upper, bounds);
    }
  }

 private:
  template <typename Real>
  void alongWay(int count, const Real* const (&lower)[3], const Real* const (&upper)[3],
                double* bounds) const {
    const Real *near[3], *far[3];
    double nearFrom[3], farFrom[3];
    for (int axis = 0; axis < 3; ++axis) {
      // By the sign and not by the lesser of the two: an empty box is left before it is entered.
      const bool isUp = inverse_[axis] > 0.0;
      near[axis] = isUp ? lower[axis] : upper[axis];
      far[axis] = isUp ? upper[axis] : lower[axis];
      nearFrom[axis] = isUp ? high_[axis] : low_[axis];
      farFrom[axis] = isUp ? low_[axis] : high_[axis];
    }
    const double shrink = 1.0 / kInflation;
    for (int i = 0; i < count; ++i) {
      double first = 0.0, last = reach_;
      for (int axis = 0; axis < 3; ++axis) {
        const double enters =
            (static_cast<double>(near[axis][i]) - nearFrom[axis]) * inverse_[axis];
        const double leaves = (static_cast<double>(far[axis][i]) - farFrom[axis]) * inverse_[axis];
        first = first > enters ? first : enters;
        last = last < leaves ? last : leaves;
      }
      bounds[i] = first <= last ? first * shrink : kBeyondReach;
    }
  }
  template <typename Real>
  void atRest(int count, const Real* const (&lower)[3], const Real* const (&upper)[3],
              double* bounds) const {
    for (int i = 0; i < count; ++i) {
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double below = static_cast<double>(lower[axis][i]) - high_[axis];
        const double above = low_[axis] - static_cast<double>(upper[axis][i]);
        double gap = below > above ? below : above;
        gap = gap > 0.0 ? gap : 0.0;
        square += gap * gap;
      }
      // Against the square of the reach: most are too far.
      bounds[i] = square <= squareReach_ ? lengthOf(square) : kBeyondReach;
    }
  }
  [[nodiscard]] double lengthOf(double square) const;

  bool moves_;
  double low_[3], high_[3];  ///< The shape's box, grown; a sphere's radius apart, at rest.
  double inverse_[3];
  double reach_, squareReach_, radius_;
};

}  // namespace foretouch::internal
