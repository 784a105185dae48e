// lss/segment_triangle.h: the closest points of a segment (an LSS's axis) and a triangle, in
// double. Derivation, degenerate cases and accuracy: lss/segment_triangle.md. Metres. Not
// installed.
#pragma once

#include <Eigen/Core>

#include "lss/lss.h"

namespace foretouch {

/// A pair of closest points. Both lie in their sets up to rounding whatever the input, so
/// `distance` is never below the true distance by more than the rounding that separation() accounts
/// for.
struct ClosestPoints {
  Eigen::Vector3d onSegment = Eigen::Vector3d::Zero();
  Eigen::Vector3d onTriangle = Eigen::Vector3d::Zero();
  /// onSegment - onTriangle, computed before the far origin is added back: far from the origin of
  /// the world it keeps the digits that the two points lose.
  Eigen::Vector3d difference = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< |difference|; 0, up to rounding, if segment and triangle cross.
  /// Normal of the features that face each other (triangle face, or edge x axis), not unit; zero if
  /// a vertex is involved. Its direction stays accurate when the distance vanishes; its sign is
  /// arbitrary.
  Eigen::Vector3d featureNormal = Eigen::Vector3d::Zero();
};

/// Segment from `a` to `b`; zero length is legal. Triangles without area are legal: a segment, a
/// point. All coordinates finite, below 1e100. The result does not depend on the order of the
/// triangle's vertices if they come sorted (middleware/scene/scene.h), nor on the distance from the
/// origin: all arithmetic is relative to the triangle's first vertex.
[[nodiscard]] ClosestPoints closestPoints(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Triangle& triangle);

}  // namespace foretouch
