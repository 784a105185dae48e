// The hierarchy with sixteen parts below each node: every triangle is below it once, side by side
// with what lanes would read of it one by one, and no deeper than it need be.
#include "middleware/surface/wide_nodes.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::Random;

/// Of all nodes and triangles below the root.
struct WideTally {
  std::vector<int> found;  // per triangle
  int nodes = 0, full = 0, deepest = 0;
};

void expectSame(const LanePart& part, const PartRows& rows, std::size_t lane) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(rows.point[i][axis][lane], part.point[i][axis]);
    }
  }
  EXPECT_EQ(rows.rho[lane], part.rho);
  EXPECT_EQ(rows.radius[lane], part.radius);
}

void walk(const WideNodes& wide, const LssHierarchy& hierarchy,
          const std::vector<LanePart>& triangles, HierarchyChild node, int depth,
          WideTally& tally) {
  const WideNode& here = wide.at(node);
  ++tally.nodes;
  tally.full += here.parts.count == static_cast<std::int32_t>(kTrianglePairLanes) ? 1 : 0;
  tally.deepest = std::max(tally.deepest, depth);
  ASSERT_GE(here.parts.count, 2);
  ASSERT_LE(here.parts.count, static_cast<std::int32_t>(kTrianglePairLanes));
  bool areAxes = true;
  for (std::size_t lane = 0; lane < slotOf(here.parts.count); ++lane) {
    const HierarchyChild part = here.below[lane];
    areAxes = areAxes && !part.isTriangle();
    if (part.isTriangle()) {
      ++tally.found[slotOf(part.index())];
      expectSame(triangles[slotOf(part.index())], here.parts, lane);
    } else {
      expectSame(lanePart(hierarchy.node(part.index()).lss), here.parts, lane);
      walk(wide, hierarchy, triangles, part, depth + 1, tally);
    }
  }
  EXPECT_EQ(here.parts.areAxes, areAxes);
}

TEST(WideNodes, HaveEveryTriangleOnceAndAsFewLevelsAsSixteenBelowEachAllow) {
  int nodes = 0, full = 0;
  for (const int count : {2, 3, 15, 16, 17, 31, 33, 255, 256, 257, 1000, 4097}) {
    SCOPED_TRACE(count);
    Random random(static_cast<std::uint64_t>(count));
    std::vector<Triangle> triangles;
    std::vector<LanePart> lanes;
    std::vector<std::int32_t> ids;
    for (int i = 0; i < count; ++i) {
      const Vector3d middle = random.inBox(1.0);
      const auto corner = [&] { return Vector3d(middle + random.inBox(0.05)); };
      triangles.push_back({{corner(), corner(), corner()}});
      lanes.push_back(lanePart(triangles.back()));
      ids.push_back(i);
    }
    const LssHierarchy hierarchy(triangles, ids);
    const WideNodes wide(hierarchy, lanes);
    WideTally tally;
    tally.found.assign(triangles.size(), 0);
    walk(wide, hierarchy, lanes, hierarchy.root(), 1, tally);
    EXPECT_EQ(std::count(tally.found.begin(), tally.found.end(), 1), count);
    int levels = 1;
    for (int most = 16; most < count; most *= 16) ++levels;
    EXPECT_EQ(tally.deepest, levels);
    nodes += tally.nodes;
    full += tally.full;
  }
  EXPECT_GT(full, 10);
  EXPECT_LT(nodes, 1500) << "hardly anything is below a node";
}

}  // namespace
}  // namespace foretouch::internal
