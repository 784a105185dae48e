// tessellation/ball_polytope.h: a convex polytope with corners on the lattice, close around or
// close inside a ball about the origin. All lengths in lattice spacings. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/result.h"
#include "tessellation/lattice.h"

namespace foretouch {

/// Triangles seen from outside counter-clockwise; convex (checked exactly), facets may be coplanar.
/// Made of an icosahedron's faces, each cut into frequency^2 triangles: 10 f^2 + 2 corners, 20 f^2
/// facets, 30 f^2 edges.
struct BallPolytope {
  struct Facet {
    std::array<std::int32_t, 3> corners{};
    LatticePoint normal;  ///< Outward, not unit, exact.
  };
  /// From corner `u` to corner `v`; `left` and `right` are the facets on either side, seen from
  /// outside.
  struct Edge {
    std::int32_t u = 0, v = 0, left = 0, right = 0;
  };

  std::vector<LatticePoint> corners;
  std::vector<Facet> facets;
  std::vector<Edge> edges;
  /// Per corner, where its edges start in `edgesAround`: all of them, counter-clockwise seen from
  /// outside.
  std::vector<std::int32_t> firstEdgeOf;
  std::vector<std::int32_t> edgesAround;
  double inradius = 0.0;      ///< A ball's about the origin inside all facets, rounded down.
  double circumradius = 0.0;  ///< A ball's about the origin around all corners, rounded up.
  int frequency = 0;
};

/// Finer polytopes are errors: 20 million facets.
inline constexpr int kMaxPolytopeFrequency = 1000;

/// A polytope that contains the ball of `radius` and leaves it by at most `excess` (both in
/// spacings, at least 4). Error if that takes more facets, or larger numbers, than allowed.
[[nodiscard]] Result<BallPolytope> polytopeAround(double radius, double excess);

/// A polytope inside the ball of `radius` that leaves out at most a layer of `lack`.
[[nodiscard]] Result<BallPolytope> polytopeWithin(double radius, double lack);

}  // namespace foretouch
