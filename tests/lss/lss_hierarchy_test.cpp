#include "lss/lss_hierarchy.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;

/// A bent tube of about `count` triangles, as a limb's mesh is.
std::vector<Triangle> tube(int count, double bend) {
  const int around = 12, along = std::max(1, count / (2 * around));
  const auto point = [&](int i, int k) {
    const double z = static_cast<double>(i) / along, turn = 6.283185307 * k / around;
    const double r = 0.05 + 0.02 * std::sin(7 * z);
    return Vector3d(r * std::cos(turn) + bend * z * z, r * std::sin(turn), 0.4 * z);
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < around; ++k) {
      triangles.push_back({{point(i, k), point(i + 1, k), point(i, k + 1)}});
      triangles.push_back({{point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)}});
    }
  }
  return triangles;
}

std::vector<std::int32_t> allOf(const std::vector<Triangle>& triangles) {
  std::vector<std::int32_t> ids(triangles.size());
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

void expectInside(const Triangle& triangle, const Lss& lss) {
  for (const Vector3d& vertex : triangle.vertices) {
    const Precise3 p(vertex);
    ASSERT_LE(oracle::preciseDistance(Precise3(lss.a), Precise3(lss.b), {p, p, p}),
              oracle::Precise(lss.radius));
  }
}

/// Walks below `child`, counts triangles and the depth, checks that `above` contain them.
void walk(const LssHierarchy& tree, const std::vector<Triangle>& triangles, HierarchyChild child,
          std::vector<Lss>& above, std::vector<int>& seen, std::size_t& depth) {
  depth = std::max(depth, above.size());
  if (child.isTriangle()) {
    ++seen[static_cast<std::size_t>(child.index())];
    for (const Lss& lss : above) {
      expectInside(triangles[static_cast<std::size_t>(child.index())], lss);
    }
    return;
  }
  above.push_back(tree.node(child.index()).lss);
  for (const HierarchyChild next : tree.node(child.index()).children) {
    walk(tree, triangles, next, above, seen, depth);
  }
  above.pop_back();
}

TEST(LssHierarchy, EveryNodeContainsAllItsTrianglesRoundingIncluded) {
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    std::vector<Triangle> triangles = tube(1 + random.below(150), random.uniform(0, 0.3));
    const Vector3d center = random.chance(0.3) ? random.inBox(1e5) : random.inBox(1.0);
    const auto turn = random.rotation();
    const double size = random.magnitude(1e-4, 1e2);
    for (Triangle& triangle : triangles) {
      for (Vector3d& v : triangle.vertices) v = center + size * (turn * v);
      if (random.chance(0.1)) triangle.vertices[1] = triangle.vertices[0];
    }
    const LssHierarchy tree(triangles, allOf(triangles));
    std::vector<int> seen(triangles.size(), 0);
    std::vector<Lss> above;
    std::size_t depth = 0;
    walk(tree, triangles, tree.root(), above, seen, depth);
    EXPECT_EQ(seen, std::vector<int>(triangles.size(), 1));
    EXPECT_LE(depth, 1 + std::ceil(std::log2(static_cast<double>(triangles.size()))));
    EXPECT_EQ(tree.numNodes() + 1, triangles.size());
  }
}

TEST(LssHierarchy, OneTriangleIsItsOwnTree) {
  const std::vector<Triangle> triangles(
      3, Triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}});
  const LssHierarchy tree(triangles, {2});
  ASSERT_TRUE(tree.root().isTriangle());
  EXPECT_EQ(tree.root().index(), 2);
}

TEST(LssHierarchy, CoincidentTrianglesAreSplitAllTheSame) {
  const std::vector<Triangle> triangles(
      100, Triangle{{Vector3d(1, 2, 3), Vector3d(1, 2, 4), Vector3d(2, 2, 3)}});
  const LssHierarchy tree(triangles, allOf(triangles));
  std::vector<int> seen(100, 0);
  std::vector<Lss> above;
  std::size_t depth = 0;
  walk(tree, triangles, tree.root(), above, seen, depth);
  EXPECT_LE(depth, 8u);
}

// Nodes near the leaves must be small, or the tree culls nothing.
TEST(LssHierarchy, NodesShrinkTowardsTheLeaves) {
  const std::vector<Triangle> triangles = tube(4000, 0.1);
  const LssHierarchy tree(triangles, allOf(triangles));
  HierarchyChild child = tree.root();
  const double atRoot = volume(tree.node(child.index()).lss);
  for (int level = 0; level < 6; ++level) child = tree.node(child.index()).children[0];
  EXPECT_LT(volume(tree.node(child.index()).lss), atRoot / 30.0);
  EXPECT_LE(tree.bytes(), triangles.size() * 64);
}

}  // namespace
}  // namespace foretouch
