// tests/middleware/solid_world/solid_world_allocation_test.cpp: a tick among doors and others
// allocates nothing once memory has grown.
#include <cmath>

#include <gtest/gtest.h>

#include "bench/solid/figure.h"
#include "middleware/solid_world/solid_world.h"
#include "tests/support/allocation_count.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

TEST(SolidWorldAllocation, NoTickAllocatesOnceMemoryHasGrown) {
  if (!countsAllocations()) GTEST_SKIP() << "the build has an allocator of its own";
  RawScene room, leaf;
  tools::addSheet(room, {-5, -0.1, -5}, {10, 0, 0}, {0, 0, 10});
  tools::addBox(leaf, {0, -0.05, -0.02}, {0.8, 2.0, 0.02});
  SolidWorld world = SolidWorld::build(Scene::build(room).value(), 0).value();
  const Avatar body = tools::figure();
  const BodyId one = world.add(body).value(), other = world.add(body).value();
  const BodyId door = world.world().add(Scene::build(leaf).value()).value();
  Pose pose = restPose(body.skeleton()), otherPose = pose;
  std::vector<SolidBodyTarget> targets = {{one, &pose}, {other, &otherPose}};
  std::vector<SolidBodyTick> ticks;
  std::uint64_t allocated = 0, pushed = 0;
  for (int i = 0; i < 1080; ++i) {
    const std::int64_t fromUs = world.utimeUs(), toUs = fromUs + 11'111;
    const double s = std::sin(M_PI / 45.0 * i);  // to and fro in 90 ticks, again and again
    const RigidPose at{Quaternion(Eigen::AngleAxisd(-0.8 - 0.8 * s, Vector3d::UnitY())),
                       Vector3d(-0.5, 0, -0.2)};
    if (i == 0) {
      ASSERT_TRUE(world.world().push(door, 0, at).ok());
    }
    ASSERT_TRUE(world.world().push(door, toUs, at).ok());
    pose.translations[0] = {0.2 * s, 0.95, 0.3};
    otherPose.translations[0] = {1.4 - 0.3 * s, 0.95, 0.3};
    world.world().forgetBefore(fromUs);
    const std::uint64_t before = numAllocations();
    const bool isDone = world.tick(toUs, targets, ticks).ok();
    if (i >= 900) allocated += numAllocations() - before;
    ASSERT_TRUE(isDone);
    if (i >= 900) pushed += ticks[0].contacts.size() + ticks[1].contacts.size();
  }
  EXPECT_EQ(allocated, 0u);
  EXPECT_GT(pushed, 50u);
}

}  // namespace
}  // namespace foretouch::test
