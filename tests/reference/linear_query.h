// tests/reference/linear_query.h: points that move along straight lines at constant speed over
// t in [0,1]: do two features meet, and when first? The answer is exact: no false negative and no
// false positive, degenerate cases included (always coplanar, parallel, zero area, touching at t =
// 0 or t = 1, vertex on edge). Sources: [Brochu12] for exactness as the aim, [Wang21] for the query
// set, derivation in tests/reference/linear_query.md.
//
// Every query is one question: when does the origin first lie in a moving polygon? Vertex against
// face: a triangle of differences; edge against edge: a parallelogram; vertex against edge and
// vertex against vertex: polygons that have collapsed.
#pragma once

#include <array>

#include <Eigen/Core>

#include "tests/reference/leaf.h"
#include "tests/reference/linear_point.h"

namespace foretouch {

// All coordinates finite, |coordinate| <= 1e100 and, if not zero, >= 1e-100 (asserted).
[[nodiscard]] LeafAnswer vertexFace(const LinearPoint& vertex,
                                    const std::array<LinearPoint, 3>& face);
[[nodiscard]] LeafAnswer edgeEdge(const std::array<LinearPoint, 2>& one,
                                  const std::array<LinearPoint, 2>& other);
[[nodiscard]] LeafAnswer vertexEdge(const LinearPoint& vertex,
                                    const std::array<LinearPoint, 2>& edge);
[[nodiscard]] LeafAnswer vertexVertex(const LinearPoint& one, const LinearPoint& other);

/// First contact of two moving triangles that may start in contact: an exact triangle-triangle test
/// at t = 0, then the six vertex-face and nine edge-edge queries. Features are those of the
/// earliest.
struct TrianglePairAnswer {
  LeafAnswer leaf;
  bool startsInContact = false;
  Feature one, other;
};
[[nodiscard]] TrianglePairAnswer trianglePair(const std::array<LinearPoint, 3>& one,
                                              const std::array<LinearPoint, 3>& other);

}  // namespace foretouch
