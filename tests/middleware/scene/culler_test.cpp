#include "middleware/scene/culler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lss/rounding.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/scene_parts.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/point_query_culler.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

std::vector<TriangleId> collected(const internal::TriangleCuller& culler, const Aabb& box) {
  std::vector<TriangleId> ids;
  std::uint64_t visited = 0;
  culler.collect(box, ids, visited);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Boxes of every size, some of which only touch a vertex, an ulp from missing it.
Aabb randomBox(Random& random, const Scene& scene, const Vector3d& center) {
  Aabb box;
  box.add(center + random.inBox(2.5));
  if (random.chance(0.3)) {
    const Triangle& t = scene.triangle(random.below(static_cast<int>(scene.numTriangles())));
    box = Aabb{};
    box.add(t.vertices[static_cast<std::size_t>(random.below(3))]);
    return box;
  }
  box.grow(random.magnitude(1e-9, 1.0));
  return box;
}

TEST(TriangleCullers, MissNoTriangleWhoseBoxOverlaps) {
  int overlapping = 0, superfluous = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center =
        i % 3 == 0 ? Vector3d(1e6 * random.direction()) : Vector3d(random.inBox(3));
    const int count = i == 0 ? 1 : 1 + random.below(2000);
    const Scene scene = Scene::build(test::clutter(random, count, 3, center)).value();
    const auto pointQuery = internal::PointQueryCuller::build(scene);
    ASSERT_TRUE(pointQuery.ok());
    for (int k = 0; k < 50; ++k) {
      const Aabb box = randomBox(random, scene, center);
      const auto flat = collected(scene.parts().bvh, box);
      const auto reference = collected(*pointQuery.value(), box);
      EXPECT_TRUE(std::adjacent_find(flat.begin(), flat.end()) == flat.end()) << "an id twice";
      EXPECT_TRUE(std::adjacent_find(reference.begin(), reference.end()) == reference.end());
      for (TriangleId id = 0; id < count; ++id) {
        if (!internal::boxOf(scene.triangle(id)).overlaps(box)) continue;
        ++overlapping;
        ASSERT_TRUE(std::binary_search(flat.begin(), flat.end(), id));
        ASSERT_TRUE(std::binary_search(reference.begin(), reference.end(), id));
      }
      superfluous += static_cast<int>(flat.size());
    }
  }
  EXPECT_GT(overlapping, 5000);
  EXPECT_LT(superfluous, 2 * overlapping) << "a culler that returns everything culls nothing";
}

/// Of the scene, many boxes as lanes take them: relative to its origin, one of them empty.
struct ManyBoxes {
  ManyBoxes(Random& random, const Scene& scene, const Vector3d& center) {
    for (int i = 0; i < 40; ++i) {
      const Aabb box = randomBox(random, scene, center);
      for (int axis = 0; axis < 3; ++axis) {
        const double origin = scene.parts().origin[axis];
        lower[axis].push_back(i == 7 ? 1.0F : internal::floatBelow(box.min[axis] - origin));
        upper[axis].push_back(i == 7 ? -1.0F : internal::floatAbove(box.max[axis] - origin));
      }
    }
  }
  [[nodiscard]] internal::BoxLanes lanes() const {
    internal::BoxLanes boxes;
    boxes.count = static_cast<int>(lower[0].size());
    for (int axis = 0; axis < 3; ++axis) {
      boxes.lower[axis] = lower[axis].data();
      boxes.upper[axis] = upper[axis].data();
    }
    return boxes;
  }
  std::array<std::vector<float>, 3> lower, upper;
};

/// (box, triangle) of each hit, ascending.
std::vector<std::pair<int, TriangleId>> pairsOf(const internal::TriangleCuller& culler,
                                                const ManyBoxes& boxes, const Scene& scene) {
  std::vector<internal::LeafHit> hits;
  std::uint64_t nodes = 0, leaves = 0;
  culler.collectLeaves(boxes.lanes(), hits, nodes, leaves);
  std::vector<std::pair<int, TriangleId>> pairs;
  for (const internal::LeafHit& hit : hits) {
    const internal::BvhLeaf& leaf = scene.parts().bvh.leaf(hit.leaf);
    for (int k = 0; k < leaf.count(); ++k) {
      if ((hit.triangles >> k & 1) != 0) pairs.emplace_back(hit.box, leaf.id[k]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(TriangleCullers, MissNoTriangleOfManyBoxes) {
  int overlapping = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(100 + i));
    const Scene scene = Scene::build(test::clutter(random, 300, 3, Vector3d::Zero())).value();
    const auto pointQuery = internal::PointQueryCuller::build(scene).value();
    const ManyBoxes boxes(random, scene, Vector3d::Zero());
    const auto flat = pairsOf(scene.parts().bvh, boxes, scene);
    const auto reference = pairsOf(*pointQuery, boxes, scene);
    EXPECT_TRUE(std::adjacent_find(flat.begin(), flat.end()) == flat.end()) << "a pair twice";
    EXPECT_TRUE(std::adjacent_find(reference.begin(), reference.end()) == reference.end());
    for (int box = 0; box < boxes.lanes().count; ++box) {
      Aabb own;
      for (int axis = 0; axis < 3; ++axis) {
        const auto b = static_cast<std::size_t>(box);
        own.min[axis] = scene.parts().origin[axis] + static_cast<double>(boxes.lower[axis][b]);
        own.max[axis] = scene.parts().origin[axis] + static_cast<double>(boxes.upper[axis][b]);
      }
      for (TriangleId id = 0; id < 300; ++id) {
        if (box == 7 || !internal::boxOf(scene.triangle(id)).overlaps(own)) continue;
        ++overlapping;
        EXPECT_TRUE(std::binary_search(flat.begin(), flat.end(), std::pair(box, id)));
        EXPECT_TRUE(std::binary_search(reference.begin(), reference.end(), std::pair(box, id)));
      }
    }
    const auto isEmpty = [](const auto& pair) { return pair.first == 7; };
    EXPECT_TRUE(std::none_of(flat.begin(), flat.end(), isEmpty));
    EXPECT_TRUE(std::none_of(reference.begin(), reference.end(), isEmpty));
  }
  EXPECT_GT(overlapping, 500);
}

TEST(TriangleCullers, SurviveCoincidentTriangles) {
  RawScene raw;
  raw.objectNames = {"heap"};
  for (int i = 0; i < 20000; ++i) {
    raw.triangles.push_back({{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}});
    raw.objectOf.push_back(0);
  }
  const Scene scene = Scene::build(raw).value();
  Aabb box;
  box.add(Vector3d(0.2, 0.2, 0.0));
  EXPECT_EQ(collected(scene.parts().bvh, box).size(), 20000u);
  EXPECT_EQ(collected(*internal::PointQueryCuller::build(scene).value(), box).size(), 20000u);
}

}  // namespace
}  // namespace foretouch
