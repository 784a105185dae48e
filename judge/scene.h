// judge/scene.h: the oracle's own triangles in a plain median-split tree of boxes, in double
// throughout.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "judge/vector.h"

namespace foretouch::oracle {

struct Box {
  Vec3d low{kEmpty, kEmpty, kEmpty}, high{-kEmpty, -kEmpty, -kEmpty};
  static constexpr double kEmpty = std::numeric_limits<double>::infinity();

  void add(const Vec3d& p);
  void add(const Box& other);
  [[nodiscard]] bool meets(const Box& other) const;
  /// Distance between the two boxes along the axis where it is largest: at most their distance.
  [[nodiscard]] double gap(const Box& other) const;
};

class Scene {
 public:
  explicit Scene(std::vector<Triangle> triangles);

  [[nodiscard]] const Triangle& triangle(int id) const {
    return triangles_[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] int numTriangles() const { return static_cast<int>(triangles_.size()); }
  /// Around all of them; empty if there are none.
  [[nodiscard]] const Box& box() const { return nodes_.front().box; }
  /// A ball around the triangle: its center and a radius that is not too small.
  struct Ball {
    Vec3d center;
    double radius = 0.0;
  };
  [[nodiscard]] const Ball& ballOf(int id) const { return balls_[static_cast<std::size_t>(id)]; }
  [[nodiscard]] const Box& boxOf(int id) const { return boxes_[static_cast<std::size_t>(id)]; }

  /// Appends every triangle whose box meets `box`. False, with `found` unfinished, once there are
  /// more than `limit`.
  bool collect(const Box& box, std::size_t limit, std::vector<int>& found) const;

  /// Calls visit(id) for every triangle whose box is less than `within` away from `box`; visit may
  /// lower `within` to shrink a search for the nearest.
  template <typename Visit>
  void visitNear(const Box& box, double& within, Visit&& visit) const {
    std::vector<int> stack{0};
    while (!stack.empty()) {
      const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      if (!(node.box.gap(box) < within)) continue;
      for (int i = node.first; i < node.last; ++i) {
        const int id = order_[static_cast<std::size_t>(i)];
        if (boxOf(id).gap(box) < within) visit(id);
      }
      if (node.left < 0) continue;
      const bool leftNearer = nodes_[static_cast<std::size_t>(node.left)].box.gap(box) <
                              nodes_[static_cast<std::size_t>(node.right)].box.gap(box);
      stack.push_back(leftNearer ? node.right : node.left);
      stack.push_back(leftNearer ? node.left : node.right);
    }
  }

 private:
  struct Node {
    Box box;
    int left = -1, right = -1;  ///< Children, or -1 for a leaf.
    int first = 0, last = 0;    ///< A leaf's range of order_; empty otherwise.
  };
  void split(int node, int first, int last);

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
  std::vector<Ball> balls_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace foretouch::oracle
