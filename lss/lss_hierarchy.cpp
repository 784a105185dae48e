#include "lss/lss_hierarchy.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/fit.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Three times the centroid: enough to compare by.
Vector3d centroidSum(const Triangle& triangle) {
  return triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2];
}

std::vector<Vector3d> cornersOf(const std::vector<Triangle>& triangles, const std::int32_t* first,
                                const std::int32_t* last) {
  std::vector<Vector3d> corners;
  corners.reserve(3 * static_cast<std::size_t>(last - first));
  for (const std::int32_t* id = first; id != last; ++id) {
    const auto& vertices = triangles[slotOf(*id)].vertices;
    corners.insert(corners.end(), vertices.begin(), vertices.end());
  }
  return corners;
}

/// The axis along which the centroids spread the most.
int widestAxis(const std::vector<Triangle>& triangles, const std::int32_t* first,
               const std::int32_t* last) {
  Vector3d low = centroidSum(triangles[slotOf(*first)]), high = low;
  for (const std::int32_t* id = first; id != last; ++id) {
    const Vector3d center = centroidSum(triangles[slotOf(*id)]);
    low = low.cwiseMin(center);
    high = high.cwiseMax(center);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

}  // namespace

LssHierarchy::LssHierarchy(const std::vector<Triangle>& triangles,
                           const std::vector<std::int32_t>& ids) {
  FORETOUCH_ASSERT(!ids.empty());
  std::vector<std::int32_t> order = ids;
  nodes_.reserve(order.size() - 1);
  root_ = split(triangles, order.data(), order.data() + order.size());
}

// Recursion is as deep as the tree: 1 + log2 of the number of triangles.
HierarchyChild LssHierarchy::split(const std::vector<Triangle>& triangles, std::int32_t* first,
                                   std::int32_t* last) {
  if (last - first == 1) return HierarchyChild::triangle(*first);
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({fitLss(cornersOf(triangles, first, last), FitEffort::Quick),
                    {HierarchyChild::node(0), HierarchyChild::node(0)}});
  const int axis = widestAxis(triangles, first, last);
  std::int32_t* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](std::int32_t x, std::int32_t y) {
    const double cx = centroidSum(triangles[slotOf(x)])[axis];
    const double cy = centroidSum(triangles[slotOf(y)])[axis];
    return cx != cy ? cx < cy : x < y;
  });
  const HierarchyChild left = split(triangles, first, middle);
  const HierarchyChild right = split(triangles, middle, last);
  nodes_[slotOf(index)].children = {left, right};
  return HierarchyChild::node(index);
}

}  // namespace foretouch
