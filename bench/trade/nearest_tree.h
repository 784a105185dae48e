// bench/trade/nearest_tree.h: how far is a segment from the scene? A plain tree of boxes over the
// scene's triangles, split by the surface area heuristic, in doubles: the one structure that all
// strategies of `bench trade` but Foretouch's use, so that they differ only in strategy.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "middleware/scene/scene.h"

namespace foretouch::tools {

/// Counted work of a strategy, independent of the machine's load.
struct TradeWork {
  std::uint64_t nodes = 0;   ///< Nodes of a tree, or cells of a grid, visited.
  std::uint64_t pairs = 0;   ///< Distances of a link's part and a triangle (or a cell) evaluated.
  std::uint64_t states = 0;  ///< Link states evaluated (forward kinematics).
};

class NearestTree {
 public:
  /// O(n log n).
  explicit NearestTree(const Scene& scene);

  /// Distance (m) of the segment from `a` to `b` and the scene, or `cap` if it is more. Stops
  /// early, with a distance not above `enough`, once it finds one. O(log n) if things are apart.
  [[nodiscard]] double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double cap,
                                double enough, TradeWork& work) const;

 private:
  struct Box {
    Eigen::Vector3d low, high;
  };
  /// A leaf: `count` of order_ from `first`. Else count == 0, the children `first` and `first` + 1.
  struct Node {
    Box box;
    std::int32_t first = 0, count = 0;
  };
  [[nodiscard]] Box boxOf(std::size_t begin, std::size_t end) const;
  void split(std::size_t node, std::size_t begin, std::size_t end, int depth);
  /// Start of the second half, by the surface area heuristic over slices.
  [[nodiscard]] std::size_t partition(std::size_t begin, std::size_t end, int depth);

  Scene scene_;
  std::vector<TriangleId> order_;
  std::vector<Node> nodes_;
  std::vector<Eigen::Vector3d> middles_;  // of the triangles, during building
};

}  // namespace foretouch::tools
