// A body is put where a person would stand, or asked about: in rooms whose builder knows where that
// is. Nothing here shares code with what finds floors.
#include "tests/tools/setup/rooms.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/tools/setup/hand_made_level.h"
#include "tools/setup/placement_check.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using test::Room;
using test::Walkable;

constexpr unsigned kSeeds = 4;

/// Where the body's middle is after a move; its lowest point is at the move's own height.
Vector3d footAt(const Placement& place, const Vector3d& move) {
  const double turn = place.yawDeg * std::acos(-1.0) / 180.0;
  return place.origin + Vector3d(std::cos(turn) * move.x() + std::sin(turn) * move.z(), move.y(),
                                 -std::sin(turn) * move.x() + std::cos(turn) * move.z());
}

/// Half of a narrow body is over it, and the soles stand on it.
bool holds(const Walkable& floor, const Vector3d& foot) {
  constexpr double kInside = 0.1, kSoles = 0.02;
  return foot.x() > floor.minX + kInside && foot.x() < floor.maxX - kInside &&
         foot.z() > floor.minZ + kInside && foot.z() < floor.maxZ - kInside && foot.y() > floor.y &&
         foot.y() < floor.y + kSoles;
}

/// Whether the whole clip stays where a person would be.
bool standsAsAPersonWould(const Room& room, const Placement& place) {
  for (const Vector3d& move : room.moves) {
    bool isHeld = false;
    for (const Walkable& floor : room.walkable) isHeld |= holds(floor, footAt(place, move));
    if (!isHeld) return false;
  }
  return true;
}

struct Answer {
  std::optional<Standing> found;
  std::vector<PlacementCheck> checks;
  bool asks = false;
};

/// As `foretouch setup` does it.
Answer answerOf(const Room& room, const std::string& on = "") {
  const Level level = Level::build(room.scene).value();
  const WalkingBody body = test::walking(room.moves);
  const Walker walker = Walker::build(body, level, Vector3d::Zero(), on).value();
  Answer answer;
  answer.found = bestStanding(walker, Placement());
  answer.checks = checksOf(
      walker, answer.found ? *answer.found : standingAt(walker, originPlace(walker)), nullptr);
  for (const PlacementCheck& check : answer.checks) answer.asks |= check.state != CheckState::Good;
  return answer;
}

TEST(Rooms, ABodyStandsWhereAPersonWouldOrIsAskedAbout) {
  std::size_t rooms = 0, placed = 0;
  for (std::size_t kind = 0; kind < test::kRoomKinds; ++kind) {
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
      const Room room = test::roomOfKind(kind, seed);
      SCOPED_TRACE(room.name + ", seed " + std::to_string(seed));
      const Answer answer = answerOf(room);
      ++rooms;
      if (answer.asks && (room.mayAsk || room.walkable.empty())) continue;
      ASSERT_TRUE(answer.found) << describe(answer.checks);
      EXPECT_FALSE(answer.asks) << describe(answer.checks);
      EXPECT_TRUE(standsAsAPersonWould(room, answer.found->place))
          << textOf(answer.found->place) << "\n"
          << describe(answer.checks);
      ++placed;
    }
  }
  EXPECT_GE(rooms, 40u);
  EXPECT_GE(4 * placed, 3 * (rooms - 4 * kSeeds)) << "asking is no answer where there is a floor";
}

std::string textNamed(const Answer& answer, const std::string& name) {
  for (const PlacementCheck& check : answer.checks) {
    if (check.name == name) return check.text;
  }
  return "no such check";
}

TEST(Rooms, ABodyTallerThanTheRoomIsToldInOneSentence) {
  const Answer answer = answerOf(test::roomOfKind(10, 0));
  const std::string text = textNamed(answer, "level");
  EXPECT_NE(text.find("taller than the room"), std::string::npos) << text;
  EXPECT_NE(text.find("0.9"), std::string::npos) << text;
  EXPECT_FALSE(areUsable(answer.checks));
}

TEST(Rooms, ABodyTallerThanTheRoomIsToldAlsoWhereItStandsBesideIt) {
  RawScene scene;
  test::addRectangle(scene, {-0.65, 0, -0.35}, {0, 0, 0.7}, {1.3, 0, 0}, "floor");
  test::addRectangle(scene, {-0.65, 0.9, -0.35}, {1.3, 0, 0}, {0, 0, 0.7}, "roof");
  const Room room{"a cupboard", scene, {}, {{2.0, 0, 0}, {2.1, 0, 0}}, false};
  const Answer answer = answerOf(room);
  EXPECT_FALSE(areUsable(answer.checks));
  const std::string text = textNamed(answer, "level");
  EXPECT_NE(text.find("taller than the room"), std::string::npos) << text;
}

TEST(Rooms, ARoofOverNoFloorIsLeftForTheOriginAndAsked) {
  const Room room = test::roomOfKind(14, 0);
  const Answer answer = answerOf(room);
  EXPECT_FALSE(answer.found);
  EXPECT_NE(textNamed(answer, "level").find("--on OBJECT"), std::string::npos)
      << describe(answer.checks);
  const Answer asked = answerOf(room, "roof");
  ASSERT_TRUE(asked.found) << describe(asked.checks);
  EXPECT_GT(asked.found->place.origin.y(), 1.5) << "up there";
}

TEST(Rooms, OnlyWhoAsksForATableStandsOnOne) {
  Room room = test::roomOfKind(11, 0);
  room.moves = {Vector3d::Zero()};
  const Answer answer = answerOf(room, "table");
  ASSERT_TRUE(answer.found) << describe(answer.checks);
  EXPECT_NEAR(answer.found->place.origin.y(), room.walkable[0].y + 0.75, 0.02);
  EXPECT_NE(textNamed(answer, "level").find("as you said"), std::string::npos);
}

TEST(Rooms, WhoAsksForATableDoesNotStayOnTheFloorAtTheOrigin) {
  RawScene scene;
  test::addRectangle(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, "floor");
  test::addRectangle(scene, {1, 0.8, -2}, {0, 0, 4}, {3, 0, 0}, "stage");
  const Room room{"a stage", scene, {}, {{0, 0.005, 0}}, false};
  const Answer answer = answerOf(room, "stage");
  ASSERT_TRUE(answer.found) << describe(answer.checks);
  EXPECT_NEAR(answer.found->place.origin.y(), 0.8, 0.01);
}

TEST(Rooms, AnObjectThatIsNotThereIsNamed) {
  const Room room = test::roomOfKind(0, 0);
  const Level level = Level::build(room.scene).value();
  const WalkingBody body = test::walking(room.moves);
  const auto walker = Walker::build(body, level, Vector3d::Zero(), "rooof");
  ASSERT_FALSE(walker.ok());
  EXPECT_NE(describe(walker.error()).find("rooof"), std::string::npos);
  EXPECT_NE(describe(walker.error()).find("ceiling"), std::string::npos);
}

TEST(Rooms, APathThatLeavesTheFloorIsSaid) {
  Room room = test::roomOfKind(7, 0);
  room.moves.clear();
  for (int i = 0; i < 50; ++i) room.moves.emplace_back(1.0 * i, 0.0, 0.0);
  const Answer answer = answerOf(room);
  EXPECT_TRUE(answer.asks);
  EXPECT_NE(textNamed(answer, "path").find("below it in"), std::string::npos)
      << describe(answer.checks);
}

/// Layers upon layers of large triangles: Recast would need weeks and all memory.
TEST(Rooms, TooManyLayersAreRefusedByNameAndSoon) {
  RawScene scene;
  for (int i = 0; i < 20000; ++i) {
    test::addRectangle(scene, {-50, 0.005 * i, -50}, {0, 0, 100}, {100, 0, 0}, "layer");
  }
  const Level level = Level::build(std::move(scene)).value();
  const auto floor = WalkableFloor::build(level, roomOf(1.75), Vector3d::Zero(), nullptr);
  ASSERT_FALSE(floor.ok());
  EXPECT_NE(describe(floor.error()).find("too many triangles in one place"), std::string::npos);
  EXPECT_NE(describe(floor.error()).find("--place"), std::string::npos);
}

TEST(Rooms, OfALevelTooLargeThePartAroundIsLookedAt) {
  RawScene scene;
  test::addRectangle(scene, {-5000, 0, -5000}, {0, 0, 10000}, {10000, 0, 0}, "ground");
  const Level level = Level::build(std::move(scene)).value();
  const auto floor = WalkableFloor::build(level, roomOf(1.75), {3000, 0, 3000}, nullptr);
  ASSERT_TRUE(floor.ok()) << describe(floor.error());
  ASSERT_TRUE(floor.value().lookedWithin());
  EXPECT_LT(*floor.value().lookedWithin(), 200.0);
  EXPECT_EQ(floor.value().kindAt({3000, 0, 3000}, 0.1, 0.1), FloorKind::Main);
  EXPECT_EQ(floor.value().kindAt({0, 0, 0}, 0.1, 0.1), FloorKind::None);
}

}  // namespace
}  // namespace foretouch::tools
