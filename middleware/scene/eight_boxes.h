// middleware/scene/eight_boxes.h: a box of floats against eight boxes of the flat tree at once:
// those of a node's children, or of a leaf's triangles; and which of them are below a plane. Not
// installed.
#pragma once

#include <cstdint>
#include <cstring>

#include <Eigen/Core>

#include "lss/rounding.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Four floats are one vector on every machine: walks ask too little at a time to choose among
/// widths, and compilers make no vectors of comparisons by themselves.
using FourFloats = float __attribute__((vector_size(16)));
inline constexpr int kFour = 4;

inline FourFloats fourOf(const float* from) {
  FourFloats four;
  std::memcpy(&four, from, sizeof four);
  return four;
}
inline FourFloats lessOf(FourFloats x, FourFloats y) {
  return x < y ? x : y;
}
inline FourFloats moreOf(FourFloats x, FourFloats y) {
  return x > y ? x : y;
}

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

/// The boxes of a leaf's triangles; unused places repeat the last one.
inline void boxesOf(const BvhLeaf& leaf, float (&lower)[3][kBvhWidth],
                    float (&upper)[3][kBvhWidth]) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kBvhWidth; i += kFour) {
      const FourFloats a = fourOf(leaf.vertex[0][axis] + i), b = fourOf(leaf.vertex[1][axis] + i),
                       c = fourOf(leaf.vertex[2][axis] + i);
      const FourFloats least = lessOf(lessOf(a, b), c), most = moreOf(moreOf(a, b), c);
      std::memcpy(lower[axis] + i, &least, sizeof least);
      std::memcpy(upper[axis] + i, &most, sizeof most);
    }
  }
}

[[nodiscard]] inline Eight trianglesOverlapping(const BvhLeaf& leaf, const LocalBox& box) {
  float lower[3][kBvhWidth], upper[3][kBvhWidth];
  boxesOf(leaf, lower, upper);
  return eightOverlapping(lower, upper, box);
}

/// How far each of eight boxes is from another one, squared.
inline void squaredGaps(const float (&lower)[3][kBvhWidth], const float (&upper)[3][kBvhWidth],
                        const LocalBox& box, float (&squares)[kBvhWidth]) {
  for (int i = 0; i < kBvhWidth; i += kFour) {
    FourFloats sum{};
    for (int axis = 0; axis < 3; ++axis) {
      const FourFloats below = fourOf(lower[axis] + i) - box.upper[axis];
      const FourFloats above = box.lower[axis] - fourOf(upper[axis] + i);
      const FourFloats gap = moreOf(moreOf(below, above), FourFloats{});
      sum += gap * gap;
    }
    std::memcpy(squares + i, &sum, sizeof sum);
  }
}

/// Makes those squares infinite all of whose corners are less high along a normal than `cut`:
/// corners[k][axis] are eight floats.
template <std::size_t N, typename Axes>
inline void leaveOutBelow(const Axes (&corners)[N], const float (&nhat)[3], float cut,
                          float (&squares)[kBvhWidth]) {
  for (int i = 0; i < kBvhWidth; i += kFour) {
    FourFloats top = FourFloats{} - kFloatInfinity;
    for (const Axes& at : corners) {
      top = moreOf(
          nhat[0] * fourOf(at[0] + i) + nhat[1] * fourOf(at[1] + i) + nhat[2] * fourOf(at[2] + i),
          top);
    }
    const FourFloats left = top < cut ? FourFloats{} + kFloatInfinity : fourOf(squares + i);
    std::memcpy(squares + i, &left, sizeof left);
  }
}

}  // namespace foretouch::internal
