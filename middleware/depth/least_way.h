// middleware/depth/least_way.h: the shortest translation that some planes allow. Not installed.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "middleware/depth/pair_depth.h"

namespace foretouch::internal {

/// About the shortest w with nhat.w >= need for all planes, found by going from plane to plane
/// ([Hildreth57]); nothing if the planes do not seem to allow one shorter than `most`. A proposal:
/// nothing is proven of it. `weights` is memory.
[[nodiscard]] std::optional<Eigen::Vector3d> leastWay(const std::vector<PartingPlane>& planes,
                                                      double most, std::vector<double>& weights);

}  // namespace foretouch::internal
