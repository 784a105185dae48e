// middleware/flat_bvh.h: the fast culler: Embree builds the tree (rtcBuildBVH), we flatten it into
// 8-wide nodes of floats rounded outward and walk it ourselves. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "middleware/culler.h"

namespace foretouch::internal {

/// Boxes in float, relative to an origin that is subtracted in double. Subtraction and outward
/// rounding are monotone, so boxes that overlap in the world overlap here: no slack is needed.
class FlatBvh final : public TriangleCuller {
 public:
  /// `boxes[i]` belongs to triangle `ids[i]`; at least one.
  static Result<FlatBvh> build(const std::vector<Aabb>& boxes, const std::vector<TriangleId>& ids,
                               const Eigen::Vector3d& origin);

  void collect(const Aabb& box, std::vector<TriangleId>& ids,
               std::uint64_t& visited) const override;

  static constexpr int kWidth = 8;
  struct FloatBox {
    std::array<float, 3> lower, upper;
  };

 private:
  struct Node {
    // Structure of arrays: lower[axis][child]. An unused child has an inverted box.
    float lower[3][kWidth], upper[3][kWidth];
    std::uint32_t child[kWidth];  // node index, or first leaf entry where leafSize > 0
    std::uint8_t leafSize[kWidth];
  };
  friend class FlatBvhBuilder;

  [[nodiscard]] FloatBox localBox(const Aabb& box) const;
  void collectLeaf(const FloatBox& box, std::uint32_t begin, std::uint32_t size,
                   std::vector<TriangleId>& ids) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Node> nodes_;          // root first
  std::vector<FloatBox> leafBoxes_;  // in leaf order
  std::vector<TriangleId> leafIds_;
};

}  // namespace foretouch::internal
