// judge/scene.cpp: the median-split tree.
#include "judge/scene.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace foretouch::oracle {

void Box::add(const Vec3d& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void Box::add(const Box& other) {
  add(other.low);
  add(other.high);
}

bool Box::meets(const Box& o) const {
  return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
         low.z <= o.high.z && o.low.z <= high.z;
}

double Box::gap(const Box& o) const {
  return std::max({0.0, low.x - o.high.x, o.low.x - high.x, low.y - o.high.y, o.low.y - high.y,
                   low.z - o.high.z, o.low.z - high.z});
}

Scene::Scene(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  boxes_.resize(triangles_.size());
  balls_.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (const Vec3d& v : triangles_[i]) boxes_[i].add(v);
    balls_[i].center = 0.5 * boxes_[i].low + 0.5 * boxes_[i].high;
    for (const Vec3d& v : triangles_[i]) {
      balls_[i].radius = std::max(balls_[i].radius, norm(v - balls_[i].center) * (1 + 1e-12));
    }
  }
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(triangles_.size() + 1);
  nodes_.emplace_back();
  split(0, 0, numTriangles());
}

// Halving the count bounds the depth by its logarithm, whatever the triangles are.
void Scene::split(int node, int first, int last) {
  constexpr int kLeaf = 4;
  Box box;
  for (int i = first; i < last; ++i) box.add(boxOf(order_[static_cast<std::size_t>(i)]));
  const auto index = static_cast<std::size_t>(node);
  nodes_[index].box = box;
  if (last - first <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].last = last;
    return;
  }
  const Vec3d size = box.high - box.low;
  double Vec3d::*axis = &Vec3d::x;
  if (size.y > size.*axis) axis = &Vec3d::y;
  if (size.z > size.*axis) axis = &Vec3d::z;
  const int middle = first + (last - first) / 2;
  std::nth_element(
      order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int a, int b) {
        return boxOf(a).low.*axis + boxOf(a).high.*axis < boxOf(b).low.*axis + boxOf(b).high.*axis;
      });
  const int left = static_cast<int>(nodes_.size());
  nodes_[index].left = left;
  nodes_[index].right = left + 1;
  nodes_.resize(nodes_.size() + 2);
  split(left, first, middle);
  split(left + 1, middle, last);
}

bool Scene::collect(const Box& box, std::size_t limit, std::vector<int>& found) const {
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
    stack.pop_back();
    if (!node.box.meets(box)) continue;
    for (int i = node.first; i < node.last; ++i) {
      const int id = order_[static_cast<std::size_t>(i)];
      if (boxOf(id).meets(box)) found.push_back(id);
    }
    if (found.size() > limit) return false;
    if (node.left < 0) continue;
    stack.push_back(node.left);
    stack.push_back(node.right);
  }
  return true;
}

}  // namespace foretouch::oracle
