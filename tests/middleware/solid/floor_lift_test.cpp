// How far a foot that is tracked below the floor asks to be lifted.
#include "middleware/solid/floor_lift.h"

#include <gtest/gtest.h>

#include "middleware/solid/tree_pose.h"
#include "tests/middleware/solid/ball_alone.h"

namespace foretouch::test {
namespace {

TEST(FloorLift, BeginsForMoreThanTheSkinAndGoesOnForLess) {
  const Avatar avatar = ballAlone(0.1);
  SolidOptions options;
  options.feet = {true};
  internal::FloorLift lift(avatar, options);
  /// What it asks at so much above the floor, at y = 0.
  const auto askedAt = [&](double gap) {
    std::vector<LinkState> states;
    internal::placeLinks(avatar.skeleton(), ballAt({0.05, 0.1 + gap, 0.0}), states);
    return lift.asked(states);
  };
  EXPECT_EQ(askedAt(-0.03), 0.0) << "no floor is known";
  internal::ContactRow row;
  row.n = Eigen::Vector3d::UnitY();
  row.push = 1.0;
  lift.remember({row});
  EXPECT_NEAR(askedAt(-0.03), 0.03 + options.skin, 1e-12);
  EXPECT_EQ(askedAt(0.5 * options.skin), 0.0) << "for the skin alone";
  EXPECT_EQ(askedAt(-options.mostLift), 0.0) << "a step";
  EXPECT_GT(lift.update(0.032, false, 0.1), 0.0);
  EXPECT_NEAR(askedAt(0.5 * options.skin), 0.5 * options.skin, 1e-12);
  EXPECT_EQ(askedAt(2.0 * options.skin), 0.0);
}

}  // namespace
}  // namespace foretouch::test
