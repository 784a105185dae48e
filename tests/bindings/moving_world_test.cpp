// A moving world in C: its answers are those of the C++ library, bit for bit, whoever moves and is
// carried; and what ft_world_* adds holds by itself.
#include "tests/bindings/moving_world.h"

#include <array>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "lss/index.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/support/threads.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::MovingWorld;
using test::Random;

/// A body that goes to and fro.
struct Restless {
  Avatar avatar;
  std::array<Pose, 2> poses;
};

Restless restless(Random& random) {
  const test::OwnBody made = test::randomOwnBody(random);
  Restless body{made.avatar, {made.steps.from, made.steps.to}};
  for (Pose& pose : body.poses) pose.translations[0] = random.inBox(0.4);
  return body;
}

/// How many answers there were, of each kind.
struct SeenContacts {
  int pairs = 0, own = 0, ofMesh = 0, ofStill = 0;
  void add(const WorldContacts& answer) {
    for (const WorldContact& contact : answer.contacts) {
      const bool isOfTriangle = contact.a.triangle >= 0 || contact.b.triangle >= 0;
      const bool isStill = contact.b.body == kStillScene;
      own += contact.a.body == contact.b.body;
      ofStill += isStill;
      ofMesh += isOfTriangle && !isStill;
      pairs += !isOfTriangle && contact.a.body != contact.b.body;
    }
  }
};

TEST(CMovingWorld, AnswersAreThoseOfTheLibrary) {
  SeenContacts seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("case " + std::to_string(seed));
    Random random(seed);
    const RawScene still = test::doorScene();
    MovingWorld world(random.magnitude(1e-6, 1e-3), &still, random.chance(0.5));
    std::vector<Restless> bodies;
    for (int i = 0; i < 3; ++i) {
      bodies.push_back(restless(random));
      BodyOptions options;
      if (random.chance(0.4)) {
        const Avatar& avatar = bodies.back().avatar;
        options.surface =
            AvatarSurface::build(avatar, test::meshWithin(avatar, random, 6, 0.9)).value();
      }
      world.add(bodies.back().avatar, options, random.chance(0.5));
    }
    const BodyId door = world.add(test::doorScene());
    for (std::int64_t k = 0; k < 6; ++k) {
      for (BodyId body = 0; body < 3; ++body) {
        const Pose& pose = bodies[slotOf(body)].poses[slotOf(static_cast<std::int32_t>(k % 2))];
        world.push(body, 10'000 * k + 1'000 * body, pose);
      }
      world.push(door, 10'000 * k, test::doorPose(0.3 * static_cast<double>(k), {-0.3, -1, 0}));
    }
    for (const std::int64_t from : {5'000, 15'000, 30'000}) {
      world.answer(from, from + 15'000);
      seen.add(world.answerOfCxx);
    }
    world.forgetBefore(30'000);
    world.answer(30'000, 50'000);
  }
  EXPECT_GT(seen.pairs, 15);
  EXPECT_GT(seen.own, 10);
  EXPECT_GT(seen.ofMesh, 20);
  EXPECT_GT(seen.ofStill, 20);
}

/// A ball of 10 cm.
Avatar ball() {
  RawSkeleton raw;
  raw.joints = {{"ball", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(), {{{{0, 0, 0}, {0, 0, 0}, 0.1}}}).value();
}
RigidPose at(double x, double y, double z) {
  return {Quaternion::Identity(), {x, y, z}};
}

TEST(CMovingWorld, ABallIsCarriedThroughADoorAndLetGo) {
  MovingWorld world;
  const BodyId lift = world.add(ball()), carried = world.add(ball()),
               door = world.add(test::doorScene());
  world.push(lift, 0, at(-3, 0, 5));
  world.push(lift, 100'000, at(3, 0, 5));
  for (const std::int64_t us : {0, 100'000}) world.push(door, us, at(-0.45, -1, 0));
  world.attach(carried, {lift, 0, false}, 20'000, at(0, 0, -5));
  world.answer(0, 40'000);
  EXPECT_TRUE(world.answerOfCxx.contacts.empty());
  world.answer(40'000, 100'000);
  ASSERT_EQ(world.answerOfCxx.contacts.size(), 1u);
  world.detach(carried, 40'500, at(0, 0, 1));
  world.push(carried, 100'000, at(0, 0, -1));
  world.answer(40'000, 100'000);
  const auto contacts = test::contactsOf(world.c.get());
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].verdict, FT_VERDICT_CONTACT);
  EXPECT_EQ(contacts[0].a.body, carried);
  EXPECT_EQ(contacts[0].b.body, door);
  EXPECT_NEAR(contacts[0].normal[2], 1.0, 1e-6);
  EXPECT_GE(contacts[0].b.object, 0);
}

TEST(CMovingWorld, ARiderIsSeenFromTheLift) {
  MovingWorld world;
  const BodyId lift = world.add(test::doorScene()), rider = world.add(ball());
  for (const std::int64_t us : {0, 50'000, 100'000}) {
    const double along = 1e-5 * static_cast<double>(us);
    world.push(lift, us, test::doorPose(along, {0, along, 0}));
  }
  world.attach(rider, {lift, 0, true}, 0, at(0.4, 0.5, 1));
  for (const std::int64_t us : {30'000, 60'000, 110'000}) {
    world.push(rider, us, at(0.4, 0.5, 1 - 1e-5 * static_cast<double>(us)));
  }
  world.answer(0, 100'000);
  // The link that carries it is not asked.
  EXPECT_TRUE(world.answerOfCxx.contacts.empty());
  const BodyId other = world.add(ball());
  for (const std::int64_t us : {0, 100'000}) world.push(other, us, at(0.556, 1.1, 0.104));
  world.answer(0, 100'000);
  EXPECT_FALSE(world.answerOfCxx.contacts.empty());
}

// Through a door, with hardly any work for the two, and with hardly any for all.
TEST(CMovingWorld, WorkIsBoundedAsTold) {
  for (const bool isPerPair : {true, false}) {
    WorldOptions work;
    (isPerPair ? work.workPerPair : work.workPerWindow) = 300;
    MovingWorld world(1e-3, nullptr, false, work);
    const BodyId door = world.add(test::doorScene()), other = world.add(ball());
    for (const std::int64_t us : {0, 100'000}) world.push(door, us, at(-0.45, -1, 0));
    world.push(other, 0, at(0, 0, 1));
    world.push(other, 100'000, at(0, 0, -1));
    world.answer(0, 100'000);
    const auto contacts = test::contactsOf(world.c.get());
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].verdict, FT_VERDICT_UNDECIDED);
    EXPECT_EQ(contacts[0].a.link, -1);
  }
}

TEST(CMovingWorld, GroupsAreAskedAsTold) {
  const RawScene still = test::doorScene();
  MovingWorld world(1e-3, &still);
  for (const BodyGroup group : {0, 3, 31}) {
    BodyOptions options;
    options.group = group;
    const BodyId body = world.add(ball(), options);
    for (const std::int64_t us : {0, 100'000}) world.push(body, us, at(0.4, 0.5, 0.05));
  }
  const auto count = [&] {
    world.answer(0, 100'000);
    return world.answerOfCxx.contacts.size();
  };
  EXPECT_EQ(count(), 6u);
  world.ask(0, 3, false);
  EXPECT_EQ(count(), 5u);
  world.askStill(31, false);
  EXPECT_EQ(count(), 4u);
  world.ask(3, 0, true);
  world.askStill(31, true);
  EXPECT_EQ(count(), 6u);
}

TEST(CMovingWorld, WhoIsSilentIsTold) {
  MovingWorld world;
  for (const WhenSilent silent : {WhenSilent::HoldStill, WhenSilent::Undecided, WhenSilent::Wait}) {
    BodyOptions options;
    options.whenSilent = silent;
    const BodyId body = world.add(ball(), options);
    world.push(body, 0, at(0.3 * body, 0, 0));
    if (silent == WhenSilent::Wait) world.push(body, 100'000, at(-0.2, 0, 0));
  }
  world.answer(0, 100'000);
  const auto silent = test::silentOf(world.c.get());
  ASSERT_EQ(silent.size(), 2u);
  EXPECT_EQ(silent[0].taken_to, FT_SILENT_HOLD_STILL);
  EXPECT_EQ(silent[1].taken_to, FT_SILENT_UNDECIDED);
  const auto contacts = test::contactsOf(world.c.get());
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].is_assumed, 1);
}

TEST(CMovingWorld, SaysWhoItWaitsFor) {
  MovingWorld world;
  std::int64_t known = 0;
  test::expectRefused(ft_world_known_until(world.c.get(), &known, nullptr), FT_ERROR_EMPTY,
                      {"ft_world_known_until", "pose"});
  const BodyId quick = world.add(ball()), slow = world.add(ball());
  world.push(quick, 100, at(0, 0, 0));
  world.push(quick, 300, at(0, 0, 0));
  world.push(slow, 200, at(0, 0, 1));
  std::int32_t waitsFor = -1;
  ASSERT_EQ(ft_world_known_until(world.c.get(), &known, &waitsFor), FT_OK);
  EXPECT_EQ(known, 200);
  EXPECT_EQ(waitsFor, slow);
  EXPECT_EQ(ft_world_known_until(world.c.get(), nullptr, nullptr), FT_OK);
  std::size_t count = 0;
  EXPECT_EQ(ft_world_body_count(world.c.get(), &count), FT_OK);
  EXPECT_EQ(count, 2u);
}

TEST(CMovingWorld, AWindowThatIsRefusedLeavesTheLastAnswer) {
  MovingWorld world;
  for (const double x : {0.0, 0.15}) {
    const BodyId body = world.add(ball());
    for (const std::int64_t us : {0, 100}) world.push(body, us, at(x, 0, 0));
  }
  world.answer(0, 100);
  ASSERT_EQ(test::contactsOf(world.c.get()).size(), 1u);
  test::expectRefused(ft_world_answer(world.c.get(), 0, 101), FT_ERROR_OUT_OF_RANGE,
                      {"ft_world_answer: window", "after what is known", "body 0"});
  EXPECT_EQ(test::contactsOf(world.c.get()).size(), 1u);
  world.forgetBefore(50);
  test::expectRefused(ft_world_answer(world.c.get(), 49, 100), FT_ERROR_OUT_OF_RANGE,
                      {"ft_world_answer: window", "forgotten"});
  EXPECT_EQ(test::contactsOf(world.c.get()).size(), 1u);
  world.answer(50, 100);
}

TEST(CMovingWorld, ThePastIsThinnedAndBoundedAsInCxx) {
  MovingWorld world;
  const BodyId body = world.add(ball());
  for (std::int64_t k = 0; k < 100; ++k) {
    world.push(body, 1000 * k, at(1e-5 * static_cast<double>(k * k), 0, 0));
  }
  ft_world* const c = world.c.get();
  std::size_t all = 0, left = 0;
  ASSERT_EQ(ft_world_pose_bytes(c, &all), FT_OK);
  EXPECT_EQ(all, world.cxx.poseBytes());
  ASSERT_EQ(ft_world_thin_before(c, 90'000, 1e-3), FT_OK);
  ASSERT_TRUE(world.cxx.thinBefore(90'000, 1e-3).ok());
  ASSERT_EQ(ft_world_pose_bytes(c, &left), FT_OK);
  EXPECT_EQ(left, world.cxx.poseBytes());
  EXPECT_LT(left, all / 2);
  world.answer(0, 99'000);
  std::int64_t us = 0;
  ASSERT_EQ(ft_world_forget_beyond(c, left / 2, &us), FT_OK);
  EXPECT_EQ(us, world.cxx.forgetBeyond(left / 2));
  EXPECT_GT(us, 0);
  ASSERT_EQ(ft_world_forget_beyond(c, 0, nullptr), FT_OK);
  test::expectRefused(ft_world_thin_before(c, 0, -1.0), FT_ERROR_OUT_OF_RANGE,
                      {"ft_world_thin_before: metres", "-1"});
  test::expectRefused(ft_world_pose_bytes(c, nullptr), FT_ERROR_NULL_ARGUMENT, {"bytes"});
}

TEST(CMovingWorld, APoseThatIsRefusedChangesNothing) {
  MovingWorld world;
  const BodyId body = world.add(ball()), wall = world.add(test::doorScene());
  for (std::int64_t k = 0; k < 5; ++k) {
    const double bad[3] = {0, std::numeric_limits<double>::quiet_NaN(), 0};
    const double identity[4] = {1, 0, 0, 0};
    const ft_pose pose = test::SmallWorld::poseOf(identity, bad);
    test::expectRefused(ft_world_push(world.c.get(), body, 1000 * k, &pose), FT_ERROR_NON_FINITE,
                        {"ft_world_push: pose"});
    world.push(body, 1000 * k, at(0.4, 0.5, 0.3 - 0.1 * static_cast<double>(k)));
    world.push(wall, 1000 * k, at(0, 0, 0));
  }
  world.answer(0, 4000);
  EXPECT_EQ(world.answerOfCxx.contacts.size(), 1u);
}

/// The times of all contacts of many windows.
std::vector<std::int64_t> timesIn(const test::SceneHandle& door, const test::AvatarHandle& ball) {
  std::vector<std::int64_t> times;
  const auto world = test::makeWorld();
  std::int32_t bodies[2];
  EXPECT_EQ(ft_world_add_mesh(world.get(), door.get(), nullptr, &bodies[0]), FT_OK);
  EXPECT_EQ(ft_world_add_avatar(world.get(), ball.get(), nullptr, &bodies[1]), FT_OK);
  const test::PoseArrays doorAt({{Quaternion::Identity()}, {Vector3d(0, 0, 0)}});
  for (std::int64_t k = 0; k < 100; ++k) {
    const double z = k % 2 == 0 ? 1.0 : -1.0;
    const test::PoseArrays ballAt({{Quaternion::Identity()}, {Vector3d(0.4, 0.5, z)}});
    const ft_pose one = doorAt.view(), other = ballAt.view();
    EXPECT_EQ(ft_world_push(world.get(), bodies[0], 1000 * k, &one), FT_OK);
    EXPECT_EQ(ft_world_push(world.get(), bodies[1], 1000 * k, &other), FT_OK);
    if (k == 0) continue;
    EXPECT_EQ(ft_world_answer(world.get(), 1000 * (k - 1), 1000 * k), FT_OK) << ft_last_error();
    for (const auto& contact : test::contactsOf(world.get())) times.push_back(contact.time_us);
    EXPECT_EQ(ft_world_forget_before(world.get(), 1000 * k), FT_OK);
  }
  return times;
}

TEST(CMovingWorld, ThreadsThatShareScenesAndAvatarsGetTheAnswersOfOne) {
  if (!test::kHasThreads) GTEST_SKIP() << "no threads here";
  const auto door = test::makeScene(test::doorScene());
  const auto thrown = test::makeAvatar(ball());
  std::vector<std::vector<std::int64_t>> times(4);
  std::vector<std::thread> threads;
  for (auto& one : times) threads.emplace_back([&] { one = timesIn(door, thrown); });
  for (std::thread& thread : threads) thread.join();
  const auto alone = timesIn(door, thrown);
  EXPECT_EQ(alone.size(), 99u);
  for (const auto& one : times) EXPECT_EQ(one, alone);
}

}  // namespace
}  // namespace foretouch
