// middleware/lanes/near_triangles.h: which triangles are near an LSS that stands still, in float
// lanes. What is left out is proven farther, rounding included (lss_pairs.md 1, 2 and 7). Lengths
// in metres. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "middleware/lanes/lane_rows.h"
#include "middleware/scene/flat_bvh_lanes.h"

namespace foretouch::internal {

/// An LSS where it stands, relative to an origin near it.
struct StillLss {
  float a[3], b[3];  ///< The axis ends.
  float reach;       ///< The radius and all that rounds, the triangles' own share apart.
};
/// `vertexRounding`: that of the triangles' coordinates.
[[nodiscard]] StillLss stillLss(const double* a, const double* b, double radius,
                                double vertexRounding);

/// The leaves to look at: leaves[leaf[i]], of which bit k of triangles[i] is the k-th triangle.
struct LeafChoice {
  const BvhLeaf* leaves;
  const Cluster* clusters;   ///< Those of the same leaves.
  const std::int32_t* leaf;  ///< Can be read kMaxLanes beyond `count`.
  const std::uint8_t* triangles;
  std::size_t count;
};

/// Triangles that may be near, in no order. Rows are longer than `count`.
struct NearTriangles {
  std::vector<std::int32_t> id;
  std::vector<float> gap;  ///< A lower bound of the separation.
  std::size_t count = 0;
  std::size_t looked = 0;  ///< Triangles for whose closest points the search went.
};

/// Replaces `near` by the chosen triangles that are not proven farther than `within` from the LSS.
/// `origin`: the LSS's, in the leaves' frame. Takes time in proportion to the leaves.
void findNearTriangles(const StillLss& lss, float within, const LeafChoice& choice,
                       const float* origin, NearTriangles& near);

}  // namespace foretouch::internal
