// judge/heights.h: what is above and below a place of a scene's ground plan.
#pragma once

#include <vector>

#include "judge/scene.h"

namespace foretouch::oracle {

/// The heights (along y, ascending) at which the vertical line through (x, z) meets triangles;
/// upright ones are left out.
[[nodiscard]] std::vector<double> heightsAt(const Scene& scene, double x, double z);

}  // namespace foretouch::oracle
