// middleware/scene/eight_boxes.h: a box of floats against eight boxes of the flat tree at once:
// those of a node's children, or of a leaf's triangles. Not installed.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "lss/rounding.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Rounded outward, relative to a tree's origin.
struct LocalBox {
  float lower[3], upper[3];
};

[[nodiscard]] inline LocalBox localBox(const Aabb& box, const Eigen::Vector3d& origin) {
  LocalBox local;
  for (int axis = 0; axis < 3; ++axis) {
    local.lower[axis] = floatBelow(box.min[axis] - origin[axis]);
    local.upper[axis] = floatAbove(box.max[axis] - origin[axis]);
  }
  return local;
}

/// One flag per box of eight, without branches, so that the compiler can vectorise.
struct Eight {
  std::uint8_t overlaps[kBvhWidth];
};

[[nodiscard]] inline Eight eightOverlapping(const float (&lower)[3][kBvhWidth],
                                            const float (&upper)[3][kBvhWidth],
                                            const LocalBox& box) {
  Eight eight;
  for (int i = 0; i < kBvhWidth; ++i) {
    const auto atMost = [](float x, float y) { return static_cast<unsigned>(x <= y); };
    eight.overlaps[i] = static_cast<std::uint8_t>(
        atMost(lower[0][i], box.upper[0]) & atMost(box.lower[0], upper[0][i]) &
        atMost(lower[1][i], box.upper[1]) & atMost(box.lower[1], upper[1][i]) &
        atMost(lower[2][i], box.upper[2]) & atMost(box.lower[2], upper[2][i]));
  }
  return eight;
}

/// Of a leaf's triangles; unused places repeat the last one.
[[nodiscard]] inline Eight trianglesOverlapping(const BvhLeaf& leaf, const LocalBox& box) {
  float lower[3][kBvhWidth], upper[3][kBvhWidth];
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kBvhWidth; ++i) {
      const float a = leaf.vertex[0][axis][i];
      const float b = leaf.vertex[1][axis][i];
      const float c = leaf.vertex[2][axis][i];
      const float lessOfAb = a < b ? a : b;
      const float moreOfAb = a > b ? a : b;
      lower[axis][i] = lessOfAb < c ? lessOfAb : c;
      upper[axis][i] = moreOfAb > c ? moreOfAb : c;
    }
  }
  return eightOverlapping(lower, upper, box);
}

}  // namespace foretouch::internal
