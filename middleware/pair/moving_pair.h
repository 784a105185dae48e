// middleware/pair/moving_pair.h: two convex parts at one instant, either of which may move: a
// proven bound on their separation, and for how long it holds. An LSS, a triangle of a mesh, of a
// skin or of the scene: each is a part. Proof with rounding: docs/guarantees.md 5. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/separation.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A part at one instant: the hull of two or three points, grown by `radius`, which is below zero
/// where a bound on errors is taken off a part (middleware/bracket/bracket.md). Metres; derivatives
/// per unit of t. Both parts of a pair are in one frame, in which their motion is bounded.
struct MovingHull {
  Hull hull;
  double radius = 0.0;
  double radiusRate = 0.0, radiusBend = 0.0;  ///< First and second derivative of the radius.
  bool moves = false;  ///< False: the rest is zero, and for a scene's triangle also exact.
  std::array<Eigen::Vector3d, 3> velocity;
  std::array<double, 3> acceleration{}, positionRounding{}, velocityRounding{};

  [[nodiscard]] static MovingHull still(const Triangle& triangle) {
    MovingHull part;
    part.hull = Hull::of(triangle);
    return part;
  }
  /// `lss` in the frame of its link, whose state this is.
  [[nodiscard]] static MovingHull of(const Lss& lss, const AxisBounds& bounds,
                                     const LinkState& state);
};

/// A pair of parts, with all rounding errors on the safe side.
struct MovingPair {
  MovingHull one, other;
  Separation axes;              ///< That of the hulls, as computed, without radii.
  std::array<double, 3> gap{};  ///< Proven: clearance of each point of `one`, less the radii.
  double gapUpper = 0.0;        ///< Proven: the separation is at most this.

  [[nodiscard]] double gapLower() const;
  [[nodiscard]] double estimate() const { return axes.distance - (one.radius + other.radius); }
  /// For how long the separation stays at `floor` or above; 0 if that is not proven now.
  [[nodiscard]] double stepFrom(double floor) const;
};
[[nodiscard]] MovingPair movingPair(const MovingHull& one, const MovingHull& other);

/// For how long the two stay `floor` or more apart, as far as the plane of another pair at the same
/// instant proves it: one that separates an LSS often separates the parts inside it. 0 if it
/// proves nothing.
[[nodiscard]] double stepByPlane(const MovingHull& one, const MovingHull& other,
                                 const Eigen::Vector3d& nhat, double floor);

}  // namespace foretouch::internal
