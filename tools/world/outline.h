// tools/world/outline.h: the outline of a volume that nothing touches, for pictures.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "tools/world/body_shapes.h"

namespace foretouch::tools {

/// Two points per line, in the body's frame (m): of a mesh the edges at which it bends or ends (all
/// of them if it is round everywhere), of LSS circles and their axis' sides. At most
/// `kMostOutlineLines`. O(n log n).
inline constexpr std::size_t kMostOutlineLines = 20'000;
[[nodiscard]] std::vector<Eigen::Vector3d> outlineOf(const BodyShape& shape);

}  // namespace foretouch::tools
