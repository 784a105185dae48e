// Every way in which ft_solid_* can be refused.
#include <cstring>
#include <limits>

#include "tests/bindings/solid_world.h"

namespace foretouch {
namespace {

using test::expectRefused;
using test::refuse;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr auto kNegative = static_cast<std::size_t>(-1);

struct Making {
  test::SmallWorld world;
  ft_solid_options options = test::initialised(ft_solid_options_init);
  [[nodiscard]] ft_status make() const {
    auto* solid = reinterpret_cast<ft_solid*>(1);
    const ft_status status =
        ft_solid_create(world.scene.get(), world.avatar.get(), &options, &solid);
    EXPECT_EQ(solid == nullptr, status != FT_OK);
    ft_solid_destroy(solid);
    return status;
  }
};

void refuseNumber(double ft_solid_options::*option, const char* name,
                  const std::vector<double>& values) {
  for (const double value : values) {
    SCOPED_TRACE(name + (" = " + std::to_string(value)));
    refuse<Making>([&](Making& m) { m.options.*option = value; }, FT_ERROR_OUT_OF_RANGE,
                   {"ft_solid_create: ", name, "expected"});
  }
}

TEST(CSolidErrors, OfNumbers) {
  EXPECT_EQ(Making().make(), FT_OK);
  const double inf = std::numeric_limits<double>::infinity();
  refuseNumber(&ft_solid_options::skin, "skin", {0.0, -1.0, 0.2, inf, kNotANumber});
  refuseNumber(&ft_solid_options::tolerance, "tolerance", {0.0, 1e-3 + 1e-9, kNotANumber});
  refuseNumber(&ft_solid_options::catch_up, "catch_up", {0.0, -1.0, inf, kNotANumber});
  refuseNumber(&ft_solid_options::most_lift, "most_lift", {-0.1, 1.5, kNotANumber});
  refuseNumber(&ft_solid_options::most_deviation, "most_deviation", {0.0, inf, kNotANumber});
  refuseNumber(&ft_solid_options::most_limb_deviation, "most_limb_deviation",
               {0.0, inf, kNotANumber});
  refuseNumber(&ft_solid_options::patience, "patience", {-1.0, inf, kNotANumber});
  refuseNumber(&ft_solid_options::snap_notice, "snap_notice", {-1.0, inf, kNotANumber});
  refuseNumber(&ft_solid_options::placing_reach, "placing_reach", {-1.0, inf, kNotANumber});
  for (const double y : {0.0, 2.0, kNotANumber}) {
    refuse<Making>([&](Making& m) { m.options.up[1] = y; }, FT_ERROR_OUT_OF_RANGE, {"up"});
  }
}

TEST(CSolidErrors, OfWholeNumbers) {
  const auto outOfRange = [](std::int32_t ft_solid_options::*option, std::int32_t value,
                             const char* name) {
    refuse<Making>([&](Making& m) { m.options.*option = value; }, FT_ERROR_OUT_OF_RANGE, {name});
  };
  outOfRange(&ft_solid_options::floor, 2, "floor");
  outOfRange(&ft_solid_options::floor, -1, "floor");
  outOfRange(&ft_solid_options::may_snap, 2, "may_snap");
  outOfRange(&ft_solid_options::around_per_tick, -1, "around_per_tick");
  outOfRange(&ft_solid_options::around_in_all, -1, "around_in_all");
  refuse<Making>([](Making& m) { m.options.work_budget = 0; }, FT_ERROR_OUT_OF_RANGE,
                 {"work_budget"});
  refuse<Making>([](Making& m) { m.options.reserved = 1; }, FT_ERROR_STRUCT_SIZE, {"reserved"});
}

TEST(CSolidErrors, OfArrays) {
  static const double visibility[2] = {1.0, 1.0}, none[1] = {0.0}, bad[1] = {kNotANumber};
  static const std::uint8_t feet[2] = {1, 0};
  static const ft_ignored_pair ignored[1] = {{0, 1}};
  const auto withVisibility = [](const double* values, std::size_t count) {
    return [=](Making& m) { m.options.visibility = values, m.options.visibility_count = count; };
  };
  refuse<Making>(withVisibility(visibility, 2), FT_ERROR_MISMATCH, {"visibility", "one per link"});
  refuse<Making>(withVisibility(none, 1), FT_ERROR_OUT_OF_RANGE, {"visibility"});
  refuse<Making>(withVisibility(bad, 1), FT_ERROR_OUT_OF_RANGE, {"visibility"});
  refuse<Making>(withVisibility(nullptr, 1), FT_ERROR_NULL_ARGUMENT, {"visibility"});
  refuse<Making>(withVisibility(visibility, kNegative), FT_ERROR_LIMIT_EXCEEDED, {"visibility"});
  const auto withFeet = [](const std::uint8_t* values, std::size_t count) {
    return [=](Making& m) { m.options.feet = values, m.options.feet_count = count; };
  };
  refuse<Making>(withFeet(feet, 2), FT_ERROR_MISMATCH, {"feet", "one per link"});
  refuse<Making>(withFeet(nullptr, 1), FT_ERROR_NULL_ARGUMENT, {"feet"});
  const auto withIgnored = [](const ft_ignored_pair* values, std::size_t count) {
    return [=](Making& m) { m.options.ignored = values, m.options.ignored_count = count; };
  };
  refuse<Making>(withIgnored(ignored, 1), FT_ERROR_OUT_OF_RANGE, {"ignored"});
  refuse<Making>(withIgnored(nullptr, 1), FT_ERROR_NULL_ARGUMENT, {"ignored"});
  refuse<Making>(withIgnored(ignored, kNegative), FT_ERROR_LIMIT_EXCEEDED, {"ignored"});
}

TEST(CSolidErrors, OfRulesOfAnotherAvatar) {
  const test::SolidWorld world, other;
  ft_pair_rules* rules = nullptr;
  ASSERT_EQ(ft_pair_rules_create(other.avatar.get(), nullptr, &rules), FT_OK);
  const test::RulesHandle owner(rules);
  auto options = test::initialised(ft_solid_options_init);
  options.self = rules;
  ft_solid* solid = nullptr;
  expectRefused(ft_solid_create(world.scene.get(), world.avatar.get(), &options, &solid),
                FT_ERROR_MISMATCH, {"self"});
  options.self = reinterpret_cast<const ft_pair_rules*>(world.scene.get());
  expectRefused(ft_solid_create(world.scene.get(), world.avatar.get(), &options, &solid),
                FT_ERROR_WRONG_HANDLE, {"rules"});
  EXPECT_EQ(solid, nullptr);
}

TEST(CSolidErrors, OfHandles) {
  const test::SmallWorld world;
  ft_solid* solid = nullptr;
  expectRefused(ft_solid_create(nullptr, world.avatar.get(), nullptr, &solid),
                FT_ERROR_NULL_ARGUMENT, {"scene"});
  expectRefused(ft_solid_create(world.scene.get(), nullptr, nullptr, &solid),
                FT_ERROR_NULL_ARGUMENT, {"avatar"});
  expectRefused(ft_solid_create(world.scene.get(), world.avatar.get(), nullptr, nullptr),
                FT_ERROR_NULL_ARGUMENT, {"solid"});
  auto* const wrong = reinterpret_cast<ft_solid*>(world.avatar.get());
  expectRefused(ft_solid_reset(wrong), FT_ERROR_WRONG_HANDLE, {"ft_solid_reset", "solid"});
  expectRefused(ft_solid_reset(nullptr), FT_ERROR_NULL_ARGUMENT, {"solid"});
  const auto made = test::makeSolid(world.scene, world.avatar);
  expectRefused(ft_query_step(reinterpret_cast<ft_query*>(made.get()), nullptr, nullptr),
                FT_ERROR_WRONG_HANDLE, {"query"});
  expectRefused(ft_solid_change_scene(made.get(), nullptr), FT_ERROR_NULL_ARGUMENT, {"scene"});
  ft_solid_destroy(nullptr);
}

struct Following {
  test::SmallWorld world;
  test::SolidHandle solid = test::makeSolid(world.scene, world.avatar);
  ft_pose pose = world.up();
  double dt = 0.01;
  ft_solid_tick tick{};
  Following() { tick.size = sizeof tick; }
  [[nodiscard]] ft_status make() { return ft_solid_follow(solid.get(), &pose, nullptr, dt, &tick); }
};

TEST(CSolidErrors, OfTicks) {
  EXPECT_EQ(Following().make(), FT_OK);
  for (const double dt : {0.0, -1.0, 10.1, kNotANumber}) {
    refuse<Following>([&](Following& f) { f.dt = dt; }, FT_ERROR_OUT_OF_RANGE,
                      {"ft_solid_follow", "dt_s"});
  }
  refuse<Following>([](Following& f) { f.pose.joint_count = 2; }, FT_ERROR_MISMATCH,
                    {"tracked", "found 2"});
  refuse<Following>([](Following& f) { f.pose.rotations = nullptr; }, FT_ERROR_NULL_ARGUMENT,
                    {"rotations"});
  refuse<Following>([](Following& f) { f.pose.size = 3; }, FT_ERROR_STRUCT_SIZE, {"tracked"});
  refuse<Following>([](Following& f) { f.tick.size = 0; }, FT_ERROR_STRUCT_SIZE, {"ft_solid_tick"});
  Following f;
  expectRefused(ft_solid_follow(f.solid.get(), nullptr, nullptr, 0.01, &f.tick),
                FT_ERROR_NULL_ARGUMENT, {"tracked"});
  expectRefused(ft_solid_follow(f.solid.get(), &f.pose, nullptr, 0.01, nullptr),
                FT_ERROR_NULL_ARGUMENT, {"ft_solid_tick"});
  expectRefused(ft_solid_follow(nullptr, &f.pose, nullptr, 0.01, &f.tick), FT_ERROR_NULL_ARGUMENT,
                {"solid"});
}

TEST(CSolidErrors, OfAskingBeforeTheFirstTick) {
  const Following f;
  expectRefused(ft_solid_shown(f.solid.get(), nullptr, nullptr, 0, nullptr), FT_ERROR_NO_STEP, {});
  expectRefused(ft_solid_joints(f.solid.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP, {});
  expectRefused(ft_solid_contacts(f.solid.get(), nullptr, 0, nullptr), FT_ERROR_NO_STEP, {});
  expectRefused(ft_solid_way(f.solid.get(), 0, nullptr, nullptr, nullptr, 0, nullptr),
                FT_ERROR_NO_STEP, {});
}

TEST(CSolidErrors, OfRoomAndSizes) {
  Following f;
  ASSERT_EQ(f.make(), FT_OK);
  ft_solid_joint joint{};
  double rotation[4];
  std::size_t required = 0;
  expectRefused(ft_solid_joints(f.solid.get(), &joint, 0, &required), FT_ERROR_BUFFER_TOO_SMALL,
                {"joints"});
  EXPECT_EQ(required, 1u);
  expectRefused(ft_solid_joints(f.solid.get(), &joint, 1, nullptr), FT_ERROR_STRUCT_SIZE,
                {"ft_solid_joint"});
  expectRefused(ft_solid_shown(f.solid.get(), rotation, nullptr, 0, &required),
                FT_ERROR_BUFFER_TOO_SMALL, {"joints"});
  EXPECT_EQ(ft_solid_shown(f.solid.get(), rotation, nullptr, 1, nullptr), FT_OK);
}

TEST(CSolidErrors, OfPlacesToBeginAt) {
  Following f;
  const double nowhere[3] = {0, kNotANumber, 0};
  const ft_pose bad = test::SmallWorld::poseOf(test::SmallWorld::kIdentity, nowhere);
  expectRefused(ft_solid_reset_at(f.solid.get(), &bad), FT_ERROR_NON_FINITE, {"place"});
  expectRefused(ft_solid_reset_at(f.solid.get(), nullptr), FT_ERROR_NULL_ARGUMENT, {"place"});
}

/// A tick as an older and as a newer program has it.
TEST(CSolidErrors, TicksLieAsTheProgramHasThem) {
  Following f;
  std::memset(&f.tick, 0x5a, sizeof f.tick);
  f.tick.size = 16;
  ASSERT_EQ(f.make(), FT_OK);
  EXPECT_EQ(f.tick.state, FT_SOLID_EQUAL);
  EXPECT_EQ(f.tick.is_certified, 1);
  EXPECT_EQ(f.tick.joint_count, 0x5a5a5a5a5a5a5a5au);
  std::vector<unsigned char> bytes(sizeof(ft_solid_tick) + 16, 0x5a);
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(bytes.data(), &size, sizeof size);
  auto* const tick = reinterpret_cast<ft_solid_tick*>(bytes.data());
  ASSERT_EQ(ft_solid_follow(f.solid.get(), &f.pose, nullptr, 0.01, tick), FT_OK);
  EXPECT_EQ(tick->joint_count, 1u);
  EXPECT_EQ(bytes.back(), 0) << "unknown fields are zero";
}

}  // namespace
}  // namespace foretouch
