// tools/report/indexed_mesh.h: triangles with corners of their own as an indexed mesh, and as fewer
// triangles.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/report/view_document.h"

namespace foretouch::tools {

/// x, y, z a corner, three corners a triangle.
using Corners = std::vector<float>;

/// Equal corners become one vertex, zeros of either sign being equal; triangles keep their order.
[[nodiscard]] ViewMesh indexed(Corners corners);

/// Fewer triangles over some of the corners.
struct Simplified {
  Corners corners;
  double error = 0.0;  ///< Details up to about this size (m) may be gone: an estimate.
};

/// At most about `target` triangles: by collapsing edges [Garland97], and, where triangles from
/// anywhere have too little topology for that, by merging corners that share a cell of a grid; both
/// as meshoptimizer has them. Time and memory: O(n log n), O(n).
[[nodiscard]] Simplified simplified(const Corners& corners, std::size_t target);

}  // namespace foretouch::tools
