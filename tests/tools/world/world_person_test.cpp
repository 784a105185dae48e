// Oracle: balls that fly at each other on a line, of which closed forms say when they may touch.
#include "tools/world/world_person.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/world/small_stage.h"
#include "tools/world/world_windows.h"

namespace foretouch::test {
namespace {

using nlohmann::json;
using tools::LoadedWorld;
using tools::WorldPersons;

/// 10 mm at the middle of a tenth of a second.
constexpr char kBounds[] =
    R"({"format": "foretouch-bounds", "version": 1, "bounds": [
  {"part": "all", "model": "constant-rate", "rate_hz": 10, "acceleration_m_s2": 8}]})";
constexpr double kMost = 0.01;

/// A ball of 5 cm that flies from x = 0 at 1 m/s, ten poses per second.
std::string flying(const std::string& more) {
  std::string poses;
  for (int i = 0; i <= 10; ++i) poses += poseAt(0.1 * i, std::to_string(0.1 * i) + ", 0, 0");
  return sphereNamed("anna", more + poses);
}

double growthAt(double t) {
  const double u = std::fmod(t, 0.1) / 0.1;
  return 4.0 * kMost * u * (1.0 - u);
}

WorldPersons personsOf(const SmallStage& stage, const std::string& bodies) {
  stage.folder.write("ten.bounds.json", kBounds);
  const auto world = stage.load(bodies);
  EXPECT_TRUE(world.ok()) << describe(world.error());
  const auto found = tools::personsOf(world.value(), world.value().beginUs, world.value().endUs);
  EXPECT_TRUE(found.ok()) << describe(found.error());
  EXPECT_TRUE(found.value().has_value());
  return found.value().value_or(WorldPersons{});
}

/// When `is` becomes true, of a million instants of a second.
template <typename Is>
double firstAt(const Is& is) {
  for (int i = 0; i <= 1000000; ++i) {
    if (is(1e-6 * i)) return 1e-6 * i;
  }
  ADD_FAILURE() << "never";
  return 0.0;
}

TEST(WorldPersons, MeetWhoMovesExactlyOnStepsOfItsOwn) {
  const SmallStage stage;
  // The other comes from x = 1.27 m with poses at 0, 0.37 and 1 s: they meet at 0.585 s.
  const auto otherAt = [](double t) { return 1.27 - t; };
  std::string other;
  for (const double t : {0.0, 0.37, 1.0}) other += poseAt(t, std::to_string(otherAt(t)) + ", 0, 0");
  const WorldPersons persons =
      personsOf(stage, flying("bounds = \"ten.bounds.json\"\n") +
                           sphereNamed("cart", "bounds = \"exact\"\n" + other));
  EXPECT_EQ(persons.persons, 1);
  EXPECT_TRUE(persons.notes.empty());
  ASSERT_EQ(persons.touches.size(), 1u);
  const auto& touch = persons.touches[0].touch;
  EXPECT_EQ(persons.touches[0].body, 0);
  EXPECT_EQ(persons.touches[0].other, 1);
  EXPECT_TRUE(touch.isCertain);
  const auto gap = [&](double t) { return std::abs(otherAt(t) - t) - 0.1; };
  EXPECT_NEAR(touch.beginsS[0], firstAt([&](double t) { return gap(t) <= growthAt(t); }), 1e-4);
  EXPECT_NEAR(touch.beginsS[1], firstAt([&](double t) { return gap(t) <= -growthAt(t); }), 1e-4);
  EXPECT_EQ(persons.counts.unclaimed, 0);
}

TEST(WorldPersons, MeetWhoStandsButNothingIsClaimedOfWhoOnlyMoves) {
  const SmallStage stage;
  const std::string drifting = poseAt(0, "0, 0.2, 0") + poseAt(1, "1, 0.2, 0");
  const WorldPersons persons =
      personsOf(stage, flying("bounds = \"ten.bounds.json\"\n") +
                           sphereNamed("post", "position = [0.5, 0, 0]\n") +
                           sphereNamed("drifter", drifting));
  ASSERT_EQ(persons.touches.size(), 1u);
  EXPECT_EQ(persons.touches[0].other, 1);
  EXPECT_TRUE(persons.touches[0].touch.isCertain);
  ASSERT_EQ(persons.notes.size(), 1u);
  EXPECT_NE(persons.notes[0].find("drifter"), std::string::npos) << persons.notes[0];
}

TEST(WorldPersons, TouchTheSceneAndItIsWritten) {
  const SmallStage stage;
  stage.folder.write("ten.bounds.json", kBounds);
  const auto world =
      stage.load("[scene]\nfile = \"wall.obj\"\n" + flying("bounds = \"ten.bounds.json\"\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  const auto found = tools::personsOf(world.value(), world.value().beginUs, world.value().endUs);
  ASSERT_TRUE(found.ok()) << describe(found.error());
  std::istringstream lines(tools::personLines(world.value(), found.value().value()));
  std::string first, last;
  std::getline(lines, first);
  std::getline(lines, last);
  const json touch = json::parse(first)["person_touch"];
  EXPECT_EQ(touch["body"], "anna");
  EXPECT_EQ(touch["object"], "wall");
  EXPECT_EQ(touch["verdict"], "certain");
  EXPECT_EQ(touch["begins_before"], true);
  const json counts = json::parse(last)["persons"];
  EXPECT_EQ(counts["intervals"], 10);
  EXPECT_EQ(counts["certain"], 1);
}

TEST(WorldPersons, StepsOfAnotherLengthAreUnclaimed) {
  const SmallStage stage;
  std::string poses;
  for (const double t : {0.0, 0.1, 0.2, 0.5, 0.6}) {
    poses += poseAt(t, std::to_string(t) + ", 0, 0");
  }
  const WorldPersons persons =
      personsOf(stage, sphereNamed("anna", "bounds = \"ten.bounds.json\"\n" + poses) +
                           sphereNamed("post", "position = [0.35, 0, 0]\n"));
  EXPECT_EQ(persons.counts.unclaimed, 1);
}

TEST(WorldPersons, AcrossALongStepOnlyTheSpeedCounts) {
  const SmallStage stage;
  stage.folder.write("fast.bounds.json",
                     R"({"format": "foretouch-bounds", "version": 1, "bounds": [
  {"part": "all", "model": "constant-rate", "rate_hz": 10, "acceleration_m_s2": 8,
   "gap_speed_m_s": 1.5}]})");
  // The wall at x = 0 is 0.15 m before the ball at 0.2 s and 0.05 m behind it at 0.5 s.
  std::string poses;
  for (const auto& [t, x] :
       {std::pair{0.0, -0.4}, {0.1, -0.3}, {0.2, -0.2}, {0.5, 0.1}, {0.6, 0.2}}) {
    poses += poseAt(t, std::to_string(x) + ", 0, 0");
  }
  const WorldPersons persons =
      personsOf(stage, "[scene]\nfile = \"wall.obj\"\n" +
                           sphereNamed("anna", "bounds = \"fast.bounds.json\"\n" + poses));
  ASSERT_EQ(persons.touches.size(), 1u);
  const auto& touch = persons.touches[0].touch;
  EXPECT_TRUE(touch.isCertain);  // there is no way around the wall so fast
  EXPECT_NEAR(touch.beginsS[0], 0.2 + 0.15 / 1.5, 1e-4);
  EXPECT_NEAR(touch.endsS[1], 0.5 - 0.05 / 1.5, 1e-4);
  EXPECT_EQ(persons.counts.certain, 1);
  EXPECT_EQ(persons.counts.excluded, 3);
}

TEST(WorldPersons, AClipThatBreaksItsBoundsIsTold) {
  const SmallStage stage;
  // Every other pose is given: the middle one is 30 mm behind, and the bound is 10 mm.
  stage.folder.write("bent.bvh", clipAlongX({-0.9, -0.83, -0.7, -0.6, -0.5}));
  stage.folder.write("five.bounds.json",
                     R"({"format": "foretouch-bounds", "version": 1, "bounds": [
  {"part": "all", "model": "constant-rate", "rate_hz": 5, "acceleration_m_s2": 2}]})");
  const auto world = stage.load(
      "[scene]\nfile = \"wall.obj\"\n[[body]]\nname = \"anna\"\navatar = \"man.json\"\n"
      "bounds = \"five.bounds.json\"\n[body.clip]\nfile = \"bent.bvh\"\nrate = 5\n");
  ASSERT_TRUE(world.ok()) << describe(world.error());
  const auto found = tools::personsOf(world.value(), world.value().beginUs, world.value().endUs);
  ASSERT_TRUE(found.ok()) << describe(found.error());
  const auto& counts = found.value()->counts;
  EXPECT_EQ(counts.broken, 2);  // of hips and arm
  EXPECT_NEAR(counts.worstM, 0.03 - 0.01, 1e-6);
  EXPECT_NEAR(counts.worstS, 0.1, 1e-9);
  const std::string text = tools::personText(world.value(), *found.value());
  EXPECT_NE(text.find("anna: Hips at 0.100 s by 20.0 mm"), std::string::npos) << text;
}

TEST(WorldPersons, BadBoundsAreRefusedByName) {
  const SmallStage stage;
  stage.folder.write("ten.bounds.json", kBounds);
  const std::string standing = "position = [0, 0, 0]\n";
  for (const auto& [bodies, words] :
       {std::pair{sphereNamed("a", "between = \"cubic\"\n" + standing), "between"},
        std::pair{std::string("[[body]]\nname = \"a\"\nmesh = \"wall.obj\"\nbounds = \"exact\"\n"),
                  "meshes are not asked"},
        std::pair{sphereNamed("a", "bounds = \"exact\"\nbetween = \"linear\"\n" + standing),
                  "between"}}) {
    const auto refused = stage.load(bodies);
    ASSERT_FALSE(refused.ok()) << bodies;
    EXPECT_NE(describe(refused.error()).find(words), std::string::npos)
        << describe(refused.error());
  }
  const auto world = stage.load(flying("bounds = \"none.json\"\n"));
  ASSERT_TRUE(world.ok()) << describe(world.error());
  const auto absent = tools::personsOf(world.value(), world.value().beginUs, world.value().endUs);
  ASSERT_FALSE(absent.ok());
  EXPECT_NE(describe(absent.error()).find("none.json"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
