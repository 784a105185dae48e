// judge/depth_oracle.h: how deep two convex pieces are in each other, by asking many directions;
// and whether a set of pieces, moved, is clear of another. In long double. Shares no code with the
// product.
#pragma once

#include <array>
#include <vector>

#include "judge/vector.h"

namespace foretouch::oracle {

/// All points within `radius` of a segment (count 2) or of a triangle (3).
struct DepthPiece {
  int count = 2;
  std::array<Vec3d, 3> corners;
  double radius = 0.0;
};

/// `count` directions, spread evenly over the sphere.
[[nodiscard]] std::vector<Vec3r> evenDirections(int count);

/// The least, over the unit vectors, of how far `one` has to go along one until a plane across it
/// parts the two: of the support function of their difference. Over all directions it would be
/// their depth; not above zero if they are apart along one.
[[nodiscard]] Real leastToPart(const DepthPiece& one, const DepthPiece& other,
                               const std::vector<Vec3r>& along);

/// Their distance after `one` has moved, less both radii; below zero if they have points in common.
[[nodiscard]] Real separationAfter(const DepthPiece& one, const Vec3d& move,
                                   const DepthPiece& other);
/// The least of all pairs.
[[nodiscard]] Real separationAfter(const std::vector<DepthPiece>& moved, const Vec3d& move,
                                   const std::vector<DepthPiece>& others);

}  // namespace foretouch::oracle
