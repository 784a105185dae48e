// A way around a board: each of its motions is free, and it leads to the target.
#include "middleware/solid/way_around.h"

#include <gtest/gtest.h>

#include "middleware/solid/tree_pose.h"
#include "tests/middleware/solid/ball_alone.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

TEST(WayAround, LeadsToTheTargetByFreeMotions) {
  const Avatar avatar = ballAlone(0.05);
  const internal::VisualBody body(avatar, {1.0});
  const SolidOptions options;
  int corners = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Pose shown = ballAt({random.uniform(-0.1, 0.1), 0.0, -random.uniform(0.1, 0.3)});
    const Pose target = ballAt({0.0, random.uniform(-0.1, 0.1), random.uniform(0.1, 0.3)});
    const Scene scene = boardAt(Eigen::Vector3d::Zero(), 0.25);
    auto certifier = internal::Certifier::build(avatar, scene, options).value();
    std::vector<LinkState> states;
    std::vector<Eigen::Vector3d> wanted;
    internal::placeLinks(avatar.skeleton(), target, states);
    body.place(states, wanted);
    internal::WayAround way(avatar, options);
    const auto search = [&] {
      certifier.beginTick(60'000);
      way.search(body, shown, target, wanted, 0, false, certifier);
      return certifier.queries();
    };
    while (search() > 0 && !way.hasWay()) ASSERT_FALSE(way.hasFailed());
    EXPECT_EQ(search(), 0u) << "it has a way";
    certifier.beginTick(1'000'000);
    way.tighten(body, shown, target, wanted, certifier);
    Pose at = shown;
    for (int i = 0; way.hasWay() && i < 100; ++i, ++corners) {
      const Pose next = way.next();
      certifier.beginTick(1'000'000);
      EXPECT_TRUE(certifier.isClear(at, next));
      at = next;
      way.arrived(at);
    }
    EXPECT_FALSE(way.hasWay());
    EXPECT_TRUE(internal::isSamePose(at, target));
  }
  EXPECT_GE(corners, 40) << "straight through the board";
}

}  // namespace
}  // namespace foretouch::test
