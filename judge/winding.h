// judge/winding.h: how often a closed surface goes around a point, by solid angles: about 1 or -1
// inside, 0 outside, 1/2 on a face. In long double. Shares no code with the product, which counts
// crossings of a ray.
#pragma once

#include <vector>

#include "judge/vector.h"

namespace foretouch::oracle {

/// The triangles are turned alike, all outwards or all inwards. By [Oosterom83].
[[nodiscard]] Real windingOf(const Vec3r& p, const std::vector<Corners<Real>>& surface);

}  // namespace foretouch::oracle
