// The solid avatar in C: its ticks are those of the C++ library, bit for bit, whatever the library
// does in them; and what ft_solid_* adds holds by itself.
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "tests/bindings/solid_world.h"
#include "tests/support/threads.h"

namespace foretouch {
namespace {

using test::SolidWorld;
using test::WholeTick;

constexpr double kTick = 1.0 / 90.0;

/// How often a tick had each state.
struct SeenStates {
  int equal = 0, apart = 0;
  void count(const ft_solid_tick& tick) {
    equal += tick.state == FT_SOLID_EQUAL;
    apart += tick.state == FT_SOLID_SLIDING || tick.state == FT_SOLID_HELD ||
             tick.state == FT_SOLID_FOLLOWING;
  }
};

SeenStates playBeside(const SolidWorld& world, ft_solid* c, SolidAvatar& cxx,
                      const std::vector<std::uint8_t>* lostBetween = nullptr) {
  SeenStates seen;
  SolidTick tick;
  for (int frame = 0; frame <= 300; ++frame) {
    SCOPED_TRACE("frame " + std::to_string(frame));
    const bool isLost = lostBetween != nullptr && frame > 60 && frame < 120;
    const auto* const flags = isLost ? lostBetween : nullptr;
    const Pose pose = test::armPose(world.avatarOfCxx, frame / 90.0);
    const auto done = cxx.follow({pose, kTick, flags}, tick);
    EXPECT_TRUE(done.ok()) << describe(done.error());
    const WholeTick whole = test::follow(c, pose, flags);
    test::expectSame(whole, tick, world.sceneOfCxx);
    seen.count(whole.tick);
    if (testing::Test::HasFailure()) break;
  }
  return seen;
}

TEST(CSolid, TicksAreThoseOfTheLibrary) {
  const SolidWorld world;
  auto cxx = SolidAvatar::build(world.avatarOfCxx, world.sceneOfCxx).value();
  const SeenStates seen = playBeside(world, test::makeSolid(world.scene, world.avatar).get(), cxx);
  EXPECT_GT(seen.equal, 60);
  EXPECT_GT(seen.apart, 60);
}

TEST(CSolid, TicksWithLostJointsAreThoseOfTheLibrary) {
  const SolidWorld world;
  const std::vector<std::uint8_t> flags = {1, 1, 0};
  auto cxx = SolidAvatar::build(world.avatarOfCxx, world.sceneOfCxx).value();
  playBeside(world, test::makeSolid(world.scene, world.avatar).get(), cxx, &flags);
}

TEST(CSolid, EveryOptionReachesTheLibrary) {
  const SolidWorld world;
  SolidOptions own;
  own.skin = 4e-3;
  own.tolerance = 1e-3;
  own.catchUp = 0.5;
  own.visibility = {30.0, 2.0, 1.0};
  own.floor = FloorPolicy::Hold;
  own.feet = {false, false, true};
  own.up = Eigen::Vector3d(0.0, 0.6, 0.8);
  own.mostLift = 0.05;
  own.mostDeviation = 0.25;
  own.mostLimbDeviation = 0.125;
  own.patience = 0.375;
  own.maySnap = true;
  own.snapNotice = 0.5;
  own.aroundPerTick = 7;
  own.aroundInAll = 70;
  own.placingReach = 0.75;
  own.ignored = {{0, 0}};
  own.workBudget = 5000;
  const std::uint8_t feet[3] = {0, 0, 1};
  const ft_ignored_pair ignored[1] = {{0, 0}};
  auto options = test::initialised(ft_solid_options_init);
  options.skin = own.skin;
  options.tolerance = own.tolerance;
  options.catch_up = own.catchUp;
  options.visibility = own.visibility.data();
  options.visibility_count = 3;
  options.floor = FT_SOLID_FLOOR_HOLD;
  options.feet = feet;
  options.feet_count = 3;
  options.up[1] = 0.6;
  options.up[2] = 0.8;
  options.most_lift = own.mostLift;
  options.most_deviation = own.mostDeviation;
  options.most_limb_deviation = own.mostLimbDeviation;
  options.patience = own.patience;
  options.may_snap = 1;
  options.snap_notice = own.snapNotice;
  options.around_per_tick = own.aroundPerTick;
  options.around_in_all = own.aroundInAll;
  options.placing_reach = own.placingReach;
  options.ignored = ignored;
  options.ignored_count = 1;
  options.work_budget = own.workBudget;
  auto cxx = SolidAvatar::build(world.avatarOfCxx, world.sceneOfCxx, own).value();
  const auto solid = test::makeSolid(world.scene, world.avatar, &options);
  ASSERT_NE(solid, nullptr);
  playBeside(world, solid.get(), cxx);
}

TEST(CSolid, OwnLinksStopEachOtherByTheRulesOfTheAvatar) {
  const SolidWorld world;
  SolidOptions own;
  own.self = PairRules::derive(world.avatarOfCxx).value();
  ft_pair_rules* rules = nullptr;
  ASSERT_EQ(ft_pair_rules_create(world.avatar.get(), nullptr, &rules), FT_OK);
  const test::RulesHandle owner(rules);
  auto options = test::initialised(ft_solid_options_init);
  options.self = rules;
  auto cxx = SolidAvatar::build(world.avatarOfCxx, world.sceneOfCxx, own).value();
  const auto solid = test::makeSolid(world.scene, world.avatar, &options);
  ASSERT_NE(solid, nullptr);
  playBeside(world, solid.get(), cxx);
}

/// S2 of the page: consecutive ways are one curve; its end is what is shown.
TEST(CSolid, WaysEndWithTheShownPose) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  int moved = 0;
  for (int frame = 0; frame <= 270; ++frame) {
    const auto whole = test::follow(solid.get(), test::armPose(world.avatarOfCxx, frame / 90.0));
    EXPECT_EQ(whole.tick.is_certified, 1);
    if (whole.tick.way_count == 0) continue;
    ++moved;
    EXPECT_GT(whole.tick.clearance, 0.0);
    EXPECT_EQ(whole.tick.has_appeared, frame == 0 ? 1 : 0);
    EXPECT_EQ(whole.wayTimes.front() == 0.0, frame == 0);
    const auto last = static_cast<std::ptrdiff_t>(whole.rotations.size());
    EXPECT_EQ(std::vector<double>(whole.wayRotations.end() - last, whole.wayRotations.end()),
              whole.rotations);
  }
  EXPECT_GT(moved, 100);
}

TEST(CSolid, IsEqualToAFreePoseBitForBit) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  for (const double t : {0.0, 0.01, 0.02, 0.1}) {
    const Pose pose = test::armPose(world.avatarOfCxx, t);
    const auto whole = test::follow(solid.get(), pose);
    EXPECT_EQ(whole.tick.state, FT_SOLID_EQUAL);
    const test::PoseArrays expected(pose);
    EXPECT_EQ(whole.rotations, expected.rotations);
    EXPECT_EQ(whole.translations, expected.translations);
    EXPECT_EQ(whole.tick.deviation, 0.0);
  }
}

TEST(CSolid, ResetBeginsAnew) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  const Pose above = test::armPose(world.avatarOfCxx, 0.0);
  Pose below = above;
  below.translations[0].y() = -0.5;
  test::follow(solid.get(), above);
  EXPECT_NE(test::follow(solid.get(), below).tick.state, FT_SOLID_EQUAL);
  ASSERT_EQ(ft_solid_reset(solid.get()), FT_OK);
  test::expectRefused(ft_solid_shown(solid.get(), nullptr, nullptr, 0, nullptr), FT_ERROR_NO_STEP,
                      {"ft_solid_shown", "ft_solid_follow"});
  EXPECT_EQ(test::follow(solid.get(), below).tick.state, FT_SOLID_EQUAL);
}

TEST(CSolid, BeginsWhereItIsTold) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  const Pose above = test::armPose(world.avatarOfCxx, 0.0);
  Pose below = above, inside = above;
  below.translations[0].y() = -0.5;
  inside.translations[0].y() = 0.0;
  const test::PoseArrays place(above), bad(inside);
  const ft_pose at = place.view(), within = bad.view();
  ASSERT_EQ(ft_solid_reset_at(solid.get(), &at), FT_OK) << ft_last_error();
  const auto first = test::follow(solid.get(), below);
  EXPECT_NE(first.tick.state, FT_SOLID_EQUAL) << "it came from above the table";
  EXPECT_EQ(first.tick.is_certified, 1);
  test::expectRefused(ft_solid_reset_at(solid.get(), &within), FT_ERROR_MISMATCH,
                      {"ft_solid_reset_at", "place"});
  EXPECT_EQ(test::wholeTick(solid.get(), first.tick).rotations, first.rotations);
}

TEST(CSolid, GoesOnInAnotherScene) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  const Pose above = test::armPose(world.avatarOfCxx, 0.0);
  Pose below = above;
  below.translations[0].y() = -0.5;
  test::follow(solid.get(), above);
  EXPECT_NE(test::follow(solid.get(), below).tick.state, FT_SOLID_EQUAL);
  RawScene far = test::tableScene();
  for (Triangle& triangle : far.triangles) {
    for (Eigen::Vector3d& v : triangle.vertices) v.y() -= 5.0;
  }
  {
    const auto open = test::makeScene(far);  // the solid avatar keeps it alive
    ASSERT_EQ(ft_solid_change_scene(solid.get(), open.get()), FT_OK) << ft_last_error();
  }
  test::expectRefused(ft_solid_contacts(solid.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP, {});
  WholeTick tick;
  for (int i = 0; i < 90; ++i) tick = test::follow(solid.get(), below);
  EXPECT_EQ(tick.tick.state, FT_SOLID_EQUAL);
}

TEST(CSolid, LostJointsAreToldAndKeepTheirPlace) {
  const SolidWorld world;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  const Pose above = test::armPose(world.avatarOfCxx, 0.0);
  Pose turned = above;
  turned.rotations[2] = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY());
  test::follow(solid.get(), above);
  const std::vector<std::uint8_t> flags = {1, 1, 0};
  const auto tick = test::follow(solid.get(), turned, &flags);
  EXPECT_EQ(tick.joints[2].state, FT_SOLID_JOINT_LOST);
  EXPECT_EQ(tick.joints[0].state, FT_SOLID_JOINT_FREE);
  const test::PoseArrays expected(above);
  EXPECT_EQ(tick.rotations, expected.rotations);
  EXPECT_EQ(test::follow(solid.get(), turned).joints[2].state, FT_SOLID_JOINT_FREE);
}

TEST(CSolid, ATickThatFailsChangesNothing) {
  const SolidWorld world;
  const auto disturbed = test::makeSolid(world.scene, world.avatar);
  const auto undisturbed = test::makeSolid(world.scene, world.avatar);
  for (int frame = 0; frame <= 300; frame += 10) {
    const Pose pose = test::armPose(world.avatarOfCxx, frame / 90.0);
    test::PoseArrays arrays(pose);
    arrays.translations[4] = std::nan("");
    const ft_pose bad = arrays.view();
    ft_solid_tick tick{};
    tick.size = sizeof tick;
    test::expectRefused(ft_solid_follow(disturbed.get(), &bad, nullptr, kTick, &tick),
                        FT_ERROR_NON_FINITE, {"ft_solid_follow: tracked", "Elbow"});
    EXPECT_EQ(ft_last_error_index(), 1);
    EXPECT_EQ(tick.work, 0u);
    const auto one = test::follow(disturbed.get(), pose);
    const auto other = test::follow(undisturbed.get(), pose);
    EXPECT_EQ(one.rotations, other.rotations);
    EXPECT_EQ(one.tick.work, other.tick.work);
  }
}

/// The shown rotations of all ticks.
std::vector<double> shownBy(const SolidWorld& world) {
  std::vector<double> shown;
  const auto solid = test::makeSolid(world.scene, world.avatar);
  for (int frame = 0; frame <= 300; frame += 2) {
    const auto whole = test::follow(solid.get(), test::armPose(world.avatarOfCxx, frame / 90.0));
    shown.insert(shown.end(), whole.rotations.begin(), whole.rotations.end());
  }
  return shown;
}

TEST(CSolid, ThreadsThatShareASceneAndAnAvatarGetTheTicksOfOne) {
  if (!test::kHasThreads) GTEST_SKIP() << "no threads here";
  const SolidWorld world;
  std::vector<std::vector<double>> shown(4);
  std::vector<std::thread> threads;
  for (auto& one : shown) threads.emplace_back([&] { one = shownBy(world); });
  for (std::thread& thread : threads) thread.join();
  const auto alone = shownBy(world);
  for (const auto& one : shown) EXPECT_EQ(one, alone);
}

}  // namespace
}  // namespace foretouch
