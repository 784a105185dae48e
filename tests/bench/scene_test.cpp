// tests/bench/scene_test.cpp: refined scenes are the same surface.
#include "bench/scene.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

double area(const Triangle& t) {
  return 0.5 * (t.vertices[1] - t.vertices[0]).cross(t.vertices[2] - t.vertices[0]).norm();
}

TEST(Subdivided, HasTheCountTheAreaAndTheObjects) {
  RawScene scene = test::wallAt(3.0, "wall");
  scene.triangles.push_back({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}});
  scene.objectOf.push_back(1);
  scene.objectNames.push_back("sheet");
  for (const std::size_t count : {3u, 4u, 7u, 1000u}) {
    const RawScene fine = subdivided(scene, count);
    ASSERT_EQ(fine.triangles.size(), count);
    ASSERT_EQ(fine.objectOf.size(), count);
    double wall = 0.0, sheet = 0.0, longest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Triangle& t = fine.triangles[i];
      (fine.objectOf[i] == 0 ? wall : sheet) += area(t);
      longest = std::max(longest, (t.vertices[0] - t.vertices[1]).norm());
      for (const Eigen::Vector3d& v : t.vertices) {
        EXPECT_EQ(fine.objectOf[i] == 0 ? v.x() : v.z(), fine.objectOf[i] == 0 ? 3.0 : 0.0);
      }
    }
    EXPECT_NEAR(wall, 16.0, 1e-9);
    EXPECT_NEAR(sheet, 0.5, 1e-12);
    if (count == 1000u) {
      EXPECT_LT(longest, 0.5);  // the wall's edges were 4 m and more
    }
  }
}

TEST(Subdivided, LeavesAloneWhatIsFineEnoughOrCannotBeHalved) {
  EXPECT_EQ(subdivided(test::wallAt(0.0, "wall"), 1).triangles.size(), 2u);
  RawScene point;
  point.triangles = {{{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}}};
  const double infinite = std::numeric_limits<double>::infinity();
  point.triangles.push_back({{{{infinite, 1, 1}, {1, 1, 1}, {1, 1, 1}}}});
  point.objectOf = {0, 0};
  point.objectNames = {"point"};
  EXPECT_EQ(subdivided(point, 100).triangles.size(), 2u);
}

}  // namespace
}  // namespace foretouch::tools
