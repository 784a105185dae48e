// Where a body stands, and where it could, in rooms that one can compute by hand.
#include "tools/setup/standing.h"

#include <gtest/gtest.h>

#include "tests/tools/setup/hand_made_level.h"
#include "tools/setup/placement_check.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using test::addRectangle;
using test::room;
using test::walking;

Level levelOf(RawScene raw) {
  auto level = Level::build(std::move(raw));
  if (!level.ok()) ADD_FAILURE() << describe(level.error());
  return std::move(level).value();
}

PlacementCheck checkNamed(const std::vector<PlacementCheck>& checks, const std::string& name) {
  for (const PlacementCheck& check : checks) {
    if (check.name == name) return check;
  }
  ADD_FAILURE() << "no check " << name;
  return {};
}

TEST(Level, CastsMeetTheFirstSurface) {
  const Level level = levelOf(room());
  const auto down = level.cast({0, 1, 0}, {0, -9, 0});
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->distance, 1.0, 2e-3);
  const auto fromOutside = level.cast({0, 9, 0}, {0, -9, 0});
  ASSERT_TRUE(fromOutside);
  EXPECT_NEAR(fromOutside->distance, 6.0, 2e-3);
  EXPECT_FALSE(level.cast({0, 9, 0}, {0, 4, 0}));
}

TEST(Standing, OnTheFloorIsFree) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 0.005, 0}, {1, 0.005, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), Placement());
  EXPECT_TRUE(standing.standsFree());
  EXPECT_NEAR(*standing.floorBelow, 0.005, 2e-3);
  EXPECT_FALSE(isWrong(standing));
  EXPECT_EQ(standing.floor, FloorKind::Main);
  EXPECT_TRUE(areUsable(checksOf(walker.value(), standing, nullptr)));
}

TEST(Standing, InTheVoidBesideTheRoomIsSaid) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 0.005, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), {false, {20, 0, 0}, 0});
  EXPECT_TRUE(standing.isOutside);
  EXPECT_FALSE(standing.floorBelow);
  const auto checks = checksOf(walker.value(), standing, nullptr);
  EXPECT_EQ(checkNamed(checks, "floor").state, CheckState::Bad);
  EXPECT_EQ(checkNamed(checks, "level").state, CheckState::Bad);
}

TEST(Standing, OnTopOfACeilingIsARoof) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 3.005, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), Placement());
  EXPECT_TRUE(standing.standsFree());
  EXPECT_EQ(standing.floor, FloorKind::Over);
  EXPECT_EQ(checkNamed(checksOf(walker.value(), standing, nullptr), "level").state,
            CheckState::Doubt);
  EXPECT_TRUE(isWrong(standing)) << "so a better place is looked for";
}

TEST(Standing, HalfInAWallNamesTrunkAndObject) {
  RawScene raw = room();
  addRectangle(raw, {0, 0, -3}, {0, 3, 0}, {0, 0, 6}, "partition");
  const Level level = levelOf(std::move(raw));
  const auto body = walking({{0, 0.005, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), Placement());
  ASSERT_FALSE(standing.inside.empty());
  const PlacementCheck start = checkNamed(checksOf(walker.value(), standing, nullptr), "start");
  EXPECT_EQ(start.state, CheckState::Bad);
  EXPECT_NE(start.text.find("partition"), std::string::npos) << start.text;
  EXPECT_NE(start.text.find("Hips"), std::string::npos) << start.text;
}

TEST(Standing, FeetBelowTheFloorAreSaid) {
  const Level level = levelOf(room());
  const auto body = walking({{0, -0.05, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), Placement());
  ASSERT_TRUE(standing.floorAbove);
  EXPECT_NEAR(*standing.floorAbove, 0.05, 2e-3);
  EXPECT_EQ(checkNamed(checksOf(walker.value(), standing, nullptr), "floor").state,
            CheckState::Bad);
}

TEST(Standing, ABodyThatFloatsIsSaid) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 1.0, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Standing standing = standingAt(walker.value(), Placement());
  ASSERT_TRUE(standing.floorBelow);
  EXPECT_NEAR(*standing.floorBelow, 1.0, 2e-3);
  EXPECT_EQ(checkNamed(checksOf(walker.value(), standing, nullptr), "floor").state,
            CheckState::Bad);
}

TEST(Standing, ATPoseAtTheBeginDoesNotSayTheHeight) {
  const Level level = levelOf(room());
  // 9 cm lower than the clip, as T-poses with pointed feet are.
  const auto body = walking({{0, -0.09, 0}, {0, 0, 0}, {0, 0.001, 0}, {0, 0.1, 0}, {0, 0.002, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  EXPECT_EQ(standingPose(body), 1u);
  const auto best = bestStanding(walker.value(), Placement());
  ASSERT_TRUE(best);
  EXPECT_NEAR(best->place.origin.y(), 0.003, 0.0015);
  EXPECT_NEAR(best->firstRise, -0.09, 1e-9);
  const PlacementCheck start = checkNamed(checksOf(walker.value(), *best, nullptr), "start");
  EXPECT_EQ(start.state, CheckState::Doubt);
  EXPECT_NE(start.text.find("T-pose"), std::string::npos) << start.text;
  EXPECT_NE(start.text.find("inside"), std::string::npos) << "told as what it is";
}

TEST(Standing, AFewToesInTheFloorDoNotLiftTheClip) {
  std::vector<Eigen::Vector3d> moves(40, {0, 0, 0});
  moves[7].y() = moves[20].y() = -0.03;
  EXPECT_EQ(walking(moves).poses[standingPose(walking(moves))].translations[0].y(),
            walking({{0, 0, 0}}).poses[0].translations[0].y());
}

TEST(BestStanding, IsOnTheFloorFreeOfFurniture) {
  RawScene raw = room();
  // A table over the middle, and a block that fills half the room.
  addRectangle(raw, {-1, 0.75, -1}, {0, 0, 2}, {2, 0, 0}, "table");
  addRectangle(raw, {-4, 1.2, -3}, {0, 0, 6}, {2.5, 0, 0}, "block");
  const Level level = levelOf(std::move(raw));
  const auto body = walking({{0, 0, 0}, {0, 0, 0.5}, {0, 0, 1.0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const auto best = bestStanding(walker.value(), Placement());
  ASSERT_TRUE(best);
  EXPECT_FALSE(isWrong(*best));
  EXPECT_TRUE(best->standsFree());
  const double y = best->place.origin.y();
  EXPECT_TRUE(y >= 0.001 && y <= 0.02) << "on the floor, not on the table: " << y;
  EXPECT_GT(best->place.origin.x(), 1.0) << "beside the table";
}

TEST(BestStanding, KeepsAWishThatIsRight) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 0.01, 0}, {0.5, 0.01, 0}});
  const auto walker = Walker::build(body, level);
  ASSERT_TRUE(walker.ok());
  const Placement wish{false, {1.25, 0, -0.5}, 30.0};
  const auto best = bestStanding(walker.value(), wish);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->place.origin, wish.origin);
  EXPECT_EQ(best->place.yawDeg, wish.yawDeg);
}

TEST(BestStanding, IsNowhereWithoutAFloorOrWithoutRoom) {
  RawScene wall;
  addRectangle(wall, {0, 0, 0}, {0, 4, 0}, {0, 0, 4});
  const Level upright = levelOf(std::move(wall));
  const auto body = walking({{0, 0, 0}});
  const auto beside = Walker::build(body, upright);
  ASSERT_TRUE(beside.ok());
  EXPECT_FALSE(bestStanding(beside.value(), Placement()));
  const Placement origin = originPlace(beside.value());
  EXPECT_NEAR(origin.origin.y(), 0.0, 1.1e-3) << "its own ground, at the scene's height 0";
  const auto checks = checksOf(beside.value(), standingAt(beside.value(), origin), nullptr);
  EXPECT_EQ(checkNamed(checks, "level").state, CheckState::Doubt);
  EXPECT_NE(checkNamed(checks, "level").text.find("no floor"), std::string::npos);
}

TEST(BestStanding, IsTheSameEveryTime) {
  const Level level = levelOf(room());
  const auto body = walking({{0, 0, 0}, {1, 0, 0}});
  const auto one = Walker::build(body, level), other = Walker::build(body, level);
  ASSERT_TRUE(one.ok() && other.ok());
  const Placement wish{false, {9, 9, 9}, 0.0};
  const auto a = bestStanding(one.value(), wish), b = bestStanding(other.value(), wish);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->place.origin, b->place.origin);
}

}  // namespace
}  // namespace foretouch::tools
