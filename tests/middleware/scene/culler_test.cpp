#include "middleware/scene/culler.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "middleware/scene/scene_parts.h"
#include "tests/middleware/random_scene.h"

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
    const auto pointQuery = scene.parts().pointQueryCuller();
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
  EXPECT_EQ(collected(*scene.parts().pointQueryCuller().value(), box).size(), 20000u);
}

}  // namespace
}  // namespace foretouch
