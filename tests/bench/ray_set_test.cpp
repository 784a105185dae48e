#include "bench/ray_set.h"

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

TEST(CastRaySet, CountsTheRaysThatHit) {
  const Triangle wall{{Vector3d(0, -9, -9), Vector3d(0, 9, -9), Vector3d(0, 0, 9)}};
  const Scene scene = Scene::build({{wall}, {0}, {"wall"}}).value();
  std::array<RaySegment, kRaysPerSet> rays;
  rays.fill({Vector3d(1, 0, 0), Vector3d(2, 0, 0)});  // away from it
  EXPECT_EQ(castRaySet(scene, rays).value(), 0);
  for (std::size_t i = 0; i < 5; ++i) rays[i] = {Vector3d(1, 0, 0), Vector3d(-1, 0, 0)};
  rays[5] = {Vector3d(2, 0, 0), Vector3d(1, 0, 0)};  // towards it, but too short
  EXPECT_EQ(castRaySet(scene, rays).value(), 5);
}

}  // namespace
}  // namespace foretouch::tools
