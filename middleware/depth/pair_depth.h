// middleware/depth/pair_depth.h: how deep two convex pieces are in each other, in closed form, with
// its rounding proven: an LSS and another, an LSS and a triangle. Proof: depth.md 1 to 3. Metres.
// Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/separation.h"

namespace foretouch {

/// The depth of a pair is the infimum of the lengths of all translations that leave the two without
/// a common point: 0 of two that are apart, or that only touch. Proven: lower <= depth <= upper,
/// and `one`, moved by `wayOut`, is clear of the other.
struct PairDepth {
  double lower = 0.0, upper = 0.0;
  Eigen::Vector3d wayOut = Eigen::Vector3d::Zero();  ///< |wayOut| <= upper; 0 if they are clear.
};

/// Exact but for rounding: upper - lower is about 1e-15 of the pair's extent, and at most 1e-7 of
/// it where an axis is nearly in a triangle's plane. `rounding`: no point is farther from where it
/// is given (m, >= 0). Zero lengths, zero areas and zero radii are legal; all coordinates finite,
/// below 1e100. O(1).
[[nodiscard]] PairDepth depthOf(const Lss& one, const Lss& other, double rounding = 0.0);
[[nodiscard]] PairDepth depthOf(const Lss& one, const Triangle& other, double rounding = 0.0);

namespace internal {

/// Not above the height over the origin of a plane through p: `normal`, the product of two edges,
/// has the computed `height` normal.p, and `size` is the product of their 1-norms. `extent` bounds
/// the 1-norms of p and of what it is the difference of.
[[nodiscard]] double facetHeight(const Eigen::Vector3d& normal, double size, double height,
                                 double extent);

/// Two pieces without their radii, and the sum of these with all uncertainty on either side.
struct ConvexPair {
  Hull one, other;     ///< `one` has two points.
  double least, most;  ///< They have a common point if nearer than `least`; none if farther
                       ///< apart than `most`.
};
[[nodiscard]] ConvexPair pairOf(const Lss& one, const Hull& other, double radius, double rounding);
[[nodiscard]] PairDepth depthOf(const ConvexPair& pair);

/// A plane that a pair may be parted by: moved by w, it is clear if nhat.w > need.
struct PartingPlane {
  Eigen::Vector3d nhat;  ///< Not longer than 1.
  double need;
};
/// The plane of the shortest translation that parts them.
[[nodiscard]] PartingPlane partingPlaneOf(const ConvexPair& pair);
/// The same along a direction of a length of at most 1 that is given.
[[nodiscard]] PartingPlane partingPlaneAlong(const ConvexPair& pair, const Eigen::Vector3d& nhat);
/// A little more than the plane needs, along its normal; 0 where it needs nothing.
[[nodiscard]] Eigen::Vector3d wayThrough(const PartingPlane& plane);

}  // namespace internal
}  // namespace foretouch
