// tests/middleware/reference/leaf_samples.h: inputs for the tests of exact leaves.
#pragma once

#include <array>

#include "tests/reference/linear_query.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

inline LinearPoint still(double x, double y, double z) {
  return {{x, y, z}, {x, y, z}};
}
inline LinearPoint moving(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {from, to};
}
inline LinearPoint reversed(const LinearPoint& p) {
  return {p.to, p.from};
}

/// Four points in the order of the queries: vertex and face, or two edges.
using FourPoints = std::array<LinearPoint, 4>;

inline LeafAnswer askVertexFace(const FourPoints& p) {
  return vertexFace(p[0], {p[1], p[2], p[3]});
}
inline LeafAnswer askEdgeEdge(const FourPoints& p) {
  return edgeEdge({p[0], p[1]}, {p[2], p[3]});
}

/// Coordinates from a lattice so small that every degeneracy is common.
inline FourPoints onLattice(Random& random, int half) {
  FourPoints points;
  for (LinearPoint& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      p.from[axis] = random.below(2 * half + 1) - half;
      p.to[axis] = random.below(2 * half + 1) - half;
    }
  }
  return points;
}

/// Lattice points off by as little as the last bit.
inline FourPoints nearLattice(Random& random) {
  FourPoints points = onLattice(random, 2);
  for (LinearPoint& p : points) {
    if (random.chance(0.5)) p.from += random.magnitude(1e-17, 1e-6) * random.direction();
    if (random.chance(0.5)) p.to += random.magnitude(1e-17, 1e-6) * random.direction();
  }
  return points;
}

inline FourPoints anywhere(Random& random) {
  FourPoints points;
  for (LinearPoint& p : points) p = {random.inBox(1.0), random.inBox(1.0)};
  return points;
}

}  // namespace foretouch::test
