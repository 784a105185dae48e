// judge/ball_tree.h: a link's hulls halved in turn, each part within a ball that the link carries.
#pragma once

#include <vector>

#include "judge/hull.h"

namespace foretouch::oracle {

/// A part of the link: the hulls order()[first, last), radii included, all within `radius` of
/// `center`, which is in the link's frame.
struct BallPart {
  Vec3d center;
  double radius = 0.0;
  int first = 0, last = 0;
  int left = -1, right = -1;  ///< Its halves; -1 for a single hull.

  [[nodiscard]] bool isSingle() const { return left < 0; }
};

class BallTree {
 public:
  /// Without hulls there are no parts.
  explicit BallTree(const std::vector<Hull>& hulls);

  [[nodiscard]] bool empty() const { return parts_.empty(); }
  /// Part 0 is the whole.
  [[nodiscard]] const BallPart& part(int index) const {
    return parts_[static_cast<std::size_t>(index)];
  }
  /// The hull of a single part.
  [[nodiscard]] int hullOf(const BallPart& part) const {
    return order_[static_cast<std::size_t>(part.first)];
  }

 private:
  int add(const std::vector<Hull>& hulls, int first, int last);
  void halve(const std::vector<Hull>& hulls, const Vec3d& size, int first, int last);

  std::vector<int> order_;
  std::vector<BallPart> parts_;
};

}  // namespace foretouch::oracle
