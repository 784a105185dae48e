// Triggers, depths and impulses in C: what they tell is what one sees, and bad input is refused.
#include <cmath>
#include <foretouch/mechanics.h>
#include <foretouch/triggers.h>
#include <limits>
#include <string>
#include <vector>

#include "tests/bindings/moving_world.h"

namespace foretouch {
namespace {

using test::WorldHandle;

/// A ball of 2 cm as an avatar of one joint.
Avatar ball() {
  RawSkeleton raw;
  raw.joints = {{"hand", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(),
                       {{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.02}}})
      .value();
}

struct AtPlace {
  double rotation[4] = {1, 0, 0, 0}, translation[3];
  ft_pose pose{};
  explicit AtPlace(double x, double y = 0.0) : translation{x, y, 0.0} {
    pose.size = sizeof pose;
    pose.joint_count = 1;
    pose.rotations = rotation;
    pose.translations = translation;
  }
};

void push(ft_world* world, std::int32_t body, std::int64_t us, double x) {
  const AtPlace place(x);
  ASSERT_EQ(ft_world_push(world, body, us, &place.pose), FT_OK) << ft_last_error();
}

std::vector<ft_trigger_event> eventsOf(const ft_world* world) {
  size_t count = 0;
  EXPECT_EQ(ft_world_trigger_events(world, nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_trigger_event> events(count);
  if (count == 0) return events;
  events[0].size = sizeof events[0];
  EXPECT_EQ(ft_world_trigger_events(world, events.data(), count, &count), FT_OK);
  return events;
}

/// A box of 2 cm that stands at 0, and a ball.
struct Room {
  test::MovingWorld both;
  ft_world* world = both.c.get();
  std::int32_t hand = both.add(ball()), box = -1, body = -1;
  Room() {
    const double half[3] = {0.01, 0.5, 0.5};
    EXPECT_EQ(ft_world_add_trigger_box(world, half, nullptr, &box, &body), FT_OK)
        << ft_last_error();
    const AtPlace place(0.0);
    EXPECT_EQ(ft_world_stand_trigger(world, box, 0, &place.pose), FT_OK) << ft_last_error();
  }
};

TEST(CTriggers, AHandThatPassesThroughWithinOneStepEntersAndLeaves) {
  Room room;
  EXPECT_EQ(room.box, 0);
  EXPECT_EQ(room.body, 1);
  push(room.world, room.hand, 0, -1.0);
  push(room.world, room.hand, 100'000, 1.0);
  EXPECT_EQ(ft_world_trigger_events(room.world, nullptr, 0, nullptr), FT_ERROR_NO_STEP);
  ASSERT_EQ(ft_world_follow_from(room.world, 0, nullptr), FT_OK);
  ASSERT_EQ(ft_world_follow(room.world, 100'000), FT_OK) << ft_last_error();
  const auto events = eventsOf(room.world);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, FT_EVENT_ENTER);
  EXPECT_EQ(events[1].kind, FT_EVENT_LEAVE);
  EXPECT_EQ(events[0].trigger, room.box);
  EXPECT_EQ(events[0].body, room.hand);
  EXPECT_NEAR(static_cast<double>(events[0].time_us), 48'500, 100);
  EXPECT_NEAR(static_cast<double>(events[1].time_us), 51'500, 100);
  EXPECT_EQ(events[1].since_us, events[0].time_us);
  size_t inside = 9;
  EXPECT_EQ(ft_world_occupants(room.world, nullptr, 0, &inside), FT_OK);
  EXPECT_EQ(inside, 0u);
}

TEST(CTriggers, SayWhoIsInsideAndBeginAnew) {
  Room room;
  push(room.world, room.hand, 0, 0.0);
  push(room.world, room.hand, 100'000, 0.0);
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(ft_world_follow_from(room.world, 20'000, nullptr), FT_OK);
    ASSERT_EQ(ft_world_follow(room.world, 100'000), FT_OK);
    ASSERT_EQ(eventsOf(room.world).size(), 1u);
    EXPECT_EQ(eventsOf(room.world)[0].kind, FT_EVENT_STARTS_INSIDE);
    ft_occupant inside{};
    inside.size = sizeof inside;
    size_t count = 0;
    ASSERT_EQ(ft_world_occupants(room.world, &inside, 1, &count), FT_OK);
    ASSERT_EQ(count, 1u);
    EXPECT_EQ(inside.body, room.hand);
    EXPECT_EQ(inside.link, FT_EVERY_LINK);
    EXPECT_EQ(inside.since_us, 20'000);
    EXPECT_EQ(inside.is_unresolved, 0);
  }
}

TEST(CTriggers, RefuseBadInput) {
  Room room;
  const double none[3] = {0.1, 0.0, 0.1};
  EXPECT_EQ(ft_world_add_trigger_box(room.world, none, nullptr, nullptr, nullptr),
            FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_world_add_trigger_box(room.world, nullptr, nullptr, nullptr, nullptr),
            FT_ERROR_NULL_ARGUMENT);
  EXPECT_EQ(ft_world_add_trigger_sphere(room.world, -1.0, nullptr, nullptr, nullptr),
            FT_ERROR_OUT_OF_RANGE);
  const test::SceneHandle open = test::makeScene(test::doorScene());
  EXPECT_EQ(ft_world_add_trigger_mesh(room.world, open.get(), nullptr, nullptr, nullptr),
            FT_ERROR_MISMATCH);
  EXPECT_NE(std::string(ft_last_error()).find("closed mesh"), std::string::npos);
  ft_trigger_options options{};
  ASSERT_EQ(ft_trigger_options_init(&options, sizeof options), FT_OK);
  EXPECT_EQ(options.group, 31);
  options.group = 32;
  EXPECT_EQ(ft_world_add_trigger_sphere(room.world, 1.0, &options, nullptr, nullptr),
            FT_ERROR_OUT_OF_RANGE);
  options.group = 31;
  options.by_link = 2;
  EXPECT_EQ(ft_world_add_trigger_sphere(room.world, 1.0, &options, nullptr, nullptr),
            FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_world_watch(room.world, 1, room.hand, 0), FT_ERROR_UNKNOWN_NAME);
  EXPECT_EQ(ft_world_watch(room.world, room.box, room.hand, 1), FT_ERROR_UNKNOWN_NAME);
  EXPECT_EQ(ft_world_watch(room.world, room.box, room.hand, FT_EVERY_LINK), FT_OK);
  const AtPlace place(0.0);
  EXPECT_NE(ft_world_stand_trigger(room.world, room.box, 0, &place.pose), FT_OK) << "twice";
}

TEST(CDepth, SaysHowDeepAndWhichWayOut) {
  test::MovingWorld both;
  ft_world* world = both.c.get();
  const std::int32_t one = both.add(ball()), other = both.add(ball());
  push(world, one, 0, 0.0);
  push(world, one, 100, 0.03);
  push(world, other, 0, 0.05);
  push(world, other, 100, 0.05);
  ft_depth_question question{};
  question.size = sizeof question;
  question.body = one;
  question.from_body = other;
  question.link = question.from_link = FT_EVERY_LINK;
  question.time_us = 100;
  ft_depth depth{};
  depth.size = sizeof depth;
  ASSERT_EQ(ft_world_depth(world, &question, &depth), FT_OK) << ft_last_error();
  EXPECT_EQ(depth.is_certified, 1);
  EXPECT_NEAR(depth.lower, 0.02, 1e-12);
  EXPECT_NEAR(depth.upper, 0.02, 1e-11);
  EXPECT_NEAR(depth.way_out[0], -0.02, 1e-11);
  EXPECT_EQ(depth.pair_count, 1);
  EXPECT_EQ(depth.from_lss, 0);
  question.time_us = 0;
  ASSERT_EQ(ft_world_depth(world, &question, &depth), FT_OK);
  EXPECT_EQ(depth.upper, 0.0);
  EXPECT_EQ(depth.link, -1);
  question.from_body = 7;
  EXPECT_EQ(ft_world_depth(world, &question, &depth), FT_ERROR_UNKNOWN_NAME);
  question.from_body = other;
  question.time_us = 101;
  EXPECT_EQ(ft_world_depth(world, &question, &depth), FT_ERROR_OUT_OF_RANGE);
}

TEST(CMechanics, CollideAsTheTextbookSays) {
  const double center[3] = {0, 0, 0}, rotation[4] = {1, 0, 0, 0}, at[3] = {0, 0, 0};
  const double inertia[9] = {0.004, 0, 0, 0, 0.004, 0, 0, 0, 0.004}, point[3] = {0, -0.1, 0};
  ft_collision_point given{};
  given.size = sizeof given;
  ASSERT_EQ(ft_inverse_mass_at(1.0, center, inertia, rotation, at, point, given.inverse_mass),
            FT_OK)
      << ft_last_error();
  given.normal[1] = 1.0;
  given.velocity[0] = 1.0;
  given.velocity[1] = -2.0;
  given.friction = 0.1;
  ft_collision_impulse impulse{};
  impulse.size = sizeof impulse;
  ASSERT_EQ(ft_collide(&given, &impulse), FT_OK) << ft_last_error();
  EXPECT_NEAR(impulse.on_a[1], 2.0, 1e-12);
  EXPECT_NEAR(impulse.on_a[0], -0.2, 1e-12);
  EXPECT_EQ(impulse.sticks, 0);
  EXPECT_NEAR(impulse.effective_mass, 1.0, 1e-12);
  given.restitution = 1.5;
  EXPECT_EQ(ft_collide(&given, &impulse), FT_ERROR_OUT_OF_RANGE);
  given.restitution = 0.0;
  given.velocity[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ft_collide(&given, &impulse), FT_ERROR_NON_FINITE);
  EXPECT_EQ(ft_inverse_mass_at(-1.0, center, inertia, rotation, at, point, given.inverse_mass),
            FT_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(ft_inverse_mass_at(1.0, center, inertia, nullptr, at, point, given.inverse_mass),
            FT_ERROR_NULL_ARGUMENT);
}

}  // namespace
}  // namespace foretouch
