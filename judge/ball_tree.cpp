// judge/ball_tree.cpp: halves by the median along the longest side.
#include "judge/ball_tree.h"

#include <algorithm>
#include <numeric>

#include "judge/certificate.h"
#include "judge/scene.h"

namespace foretouch::oracle {

BallTree::BallTree(const std::vector<Hull>& hulls) : order_(hulls.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  parts_.reserve(2 * hulls.size());
  if (!hulls.empty()) add(hulls, 0, static_cast<int>(hulls.size()));
}

int BallTree::add(const std::vector<Hull>& hulls, int first, int last) {
  const auto forPoints = [&](const auto& visit) {
    for (int i = first; i < last; ++i) {
      const Hull& hull = hulls[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
      for (int k = 0; k < hull.count; ++k) {
        visit(hull.points[static_cast<std::size_t>(k)], hull.radius);
      }
    }
  };
  Box box;
  forPoints([&](const Vec3d& p, double) { box.add(p); });
  BallPart part;
  part.first = first;
  part.last = last;
  part.center = 0.5 * box.low + 0.5 * box.high;
  forPoints([&](const Vec3d& p, double radius) {
    part.radius = std::max(part.radius, (norm(p - part.center) + radius) * (1 + kDoubleMargin));
  });
  const auto index = parts_.size();
  parts_.push_back(part);
  if (last - first > 1) {
    halve(hulls, box.high - box.low, first, last);
    const int middle = first + (last - first) / 2;
    const int left = add(hulls, first, middle), right = add(hulls, middle, last);
    parts_[index].left = left;
    parts_[index].right = right;
  }
  return static_cast<int>(index);
}

void BallTree::halve(const std::vector<Hull>& hulls, const Vec3d& size, int first, int last) {
  double Vec3d::*axis = &Vec3d::x;
  if (size.y > size.*axis) axis = &Vec3d::y;
  if (size.z > size.*axis) axis = &Vec3d::z;
  const auto place = [&](int id) {
    const Hull& hull = hulls[static_cast<std::size_t>(id)];
    double sum = 0;
    for (int k = 0; k < hull.count; ++k) sum += hull.points[static_cast<std::size_t>(k)].*axis;
    return sum / hull.count;
  };
  std::nth_element(order_.begin() + first, order_.begin() + first + (last - first) / 2,
                   order_.begin() + last, [&](int a, int b) { return place(a) < place(b); });
}

}  // namespace foretouch::oracle
