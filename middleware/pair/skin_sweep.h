// middleware/pair/skin_sweep.h: the space that the triangles of a skinned surface cover between
// two poses. Not installed.
#pragma once

#include <vector>

#include "middleware/pair/backtracking.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Boxes of every triangle of the link at t = 0 (`starts`) and on every piece (`boxes`, piece by
/// piece within a triangle), grown by `margin`: a blended vertex is no farther from its chord than
/// the blend of its links' A*h^2/8. `nodes`: all links' states at the pieces' boundaries.
void sweepSkin(const Side& parts, const std::vector<std::vector<LinkState>>& nodes,
               const Pieces& pieces, double margin, std::vector<Aabb>& starts,
               std::vector<Aabb>& boxes);

}  // namespace foretouch::internal
