// middleware/exact/triangles_meet.h: do two triangles at rest have a point in common? Exact. Not
// installed.
#pragma once

#include "lss/lss.h"

namespace foretouch {

/// No false positive and no false negative, for the coordinates as they are: degenerate triangles,
/// triangles in one plane and those that touch in a point included. Doubles decide where their
/// rounding cannot matter, integers the rest. All coordinates finite, |coordinate| <= 1e100
/// (asserted).
[[nodiscard]] bool trianglesMeet(const Triangle& one, const Triangle& other);

}  // namespace foretouch
