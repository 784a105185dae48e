// What a follower knows of a motion serves all windows that cut it: others' clocks neither change
// what it tells of two, nor cost looks at them.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/events/world_follower.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/events/judged_events.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::at;
using test::ball;
using test::bodyOf;
using test::Random;

constexpr std::int64_t kMs = 1'000;

void stand(World& world, BodyId body, const RigidPose& pose, std::int64_t untilUs,
           std::int64_t periodUs) {
  for (std::int64_t us = 0; us <= untilUs; us += periodUs) {
    ASSERT_TRUE(world.push(body, us, pose).ok());
  }
}

/// Rows of small triangles in the plane y = 0, which are one object; and, if there is a `floor`, a
/// triangle that is another one.
Scene gravel(int perRow, int rows, std::optional<double> floor) {
  RawScene raw;
  raw.objectNames.push_back("gravel");
  constexpr double kSize = 0.004;
  for (int i = 0; i < perRow; ++i) {
    for (int k = 0; k < rows; ++k) {
      const Vector3d p(kSize * i, 0, kSize * k);
      raw.triangles.push_back(
          {{p, p + Vector3d(0.8 * kSize, 0, 0), p + Vector3d(0, 0, 0.8 * kSize)}});
      raw.objectOf.push_back(0);
    }
  }
  if (floor) {
    raw.objectNames.push_back("floor");
    raw.triangles.push_back(
        {{Vector3d(-9, *floor, -9), Vector3d(9, *floor, -9), Vector3d(0, *floor, 9)}});
    raw.objectOf.push_back(1);
  }
  return Scene::build(std::move(raw)).value();
}

/// Follows in calls of a millisecond, as live services do.
struct Followed {
  std::vector<WorldEvent> events;
  EventCounters counters;
  std::string kinds;
};
Followed follow(const World& world, std::int64_t untilUs) {
  WorldFollower follower = WorldFollower::start(0).value();
  Followed all;
  WorldEvents answer;
  for (std::int64_t us = kMs; us <= untilUs; us += kMs) {
    const auto done = follower.follow(world, us, answer);
    EXPECT_TRUE(done.ok()) << describe(done.error());
    for (const WorldEvent& event : answer.events) {
      EXPECT_LE(us - kMs, event.time.us);
      EXPECT_LE(microsecondsAfter(0, event.time), static_cast<double>(us));
      all.kinds += std::string(toString(event.kind)) + " ";
      all.events.push_back(event);
    }
    all.counters.add(answer.counters);
  }
  return all;
}

// Ten sheets within one motion: their events come in the windows in which they happen.
TEST(FollowedMotions, TellsWhatHappensLaterInItsWindow) {
  World world = World::build(std::nullopt).value();
  const BodyId flying = world.add(ball(0.01)).value();
  std::string expected;
  for (int i = 0; i < 10; ++i) {
    stand(world, world.add(ball(0.01)).value(), at(0.1 + 0.1 * i), 40 * kMs, 40 * kMs);
    expected += "enter leave ";
  }
  stand(world, world.add(ball(0.01)).value(), at(50), 40 * kMs, kMs);
  ASSERT_TRUE(world.push(flying, 0, at(0)).ok());
  ASSERT_TRUE(world.push(flying, 40 * kMs, at(1.2)).ok());
  const Followed told = follow(world, 40 * kMs);
  EXPECT_EQ(told.kinds, expected);
  for (std::size_t i = 0; i < told.events.size(); ++i) {
    const double metres = 0.1 + 0.1 * static_cast<double>(i / 2) + (i % 2 == 0 ? -0.02 : 0.02);
    EXPECT_NEAR(microsecondsAfter(0, told.events[i].time), metres / 1.2 * 40'000.0, 100.0);
  }
}

/// Triangles of many metres across x, each an object of its own.
Scene sheets(const std::vector<double>& places) {
  RawScene raw;
  for (const double x : places) {
    raw.objectOf.push_back(static_cast<ObjectId>(raw.objectNames.size()));
    raw.objectNames.push_back("sheet " + std::to_string(raw.objectNames.size()));
    raw.triangles.push_back({{Vector3d(x, -9, -9), Vector3d(x, 9, -9), Vector3d(x, 0, 9)}});
  }
  return Scene::build(std::move(raw)).value();
}

// One object after the other, still or moving, of which windows list the link, and not the object.
// With a longer motion than is traced at once, and one whose parts are looked at, too.
TEST(FollowedMotions, TellEveryObjectInItsWindow) {
  const std::vector<double> places = {0.1, 0.2, 0.3, 0.4, 0.5};
  for (const std::int64_t motionUs : {30 * kMs, 300 * kMs}) {
    for (const bool isStill : {true, false}) {
      World world =
          World::build(isStill ? std::optional<Scene>(sheets(places)) : std::nullopt, {1e-4})
              .value();
      const BodyId flying = world.add(ball(0.02)).value();
      ASSERT_TRUE(world.push(flying, 0, at(0)).ok());
      ASSERT_TRUE(world.push(flying, motionUs, at(0.6)).ok());
      stand(world, world.add(ball(0.01)).value(), at(50), motionUs, kMs);
      if (!isStill) stand(world, world.add(sheets(places)).value(), at(0), motionUs, motionUs);
      const Followed told = follow(world, motionUs);
      ASSERT_EQ(told.events.size(), 2 * places.size());
      for (std::size_t i = 0; i < told.events.size(); ++i) {
        const WorldEvent& event = told.events[i];
        EXPECT_EQ(event.kind, i % 2 == 0 ? EventKind::Enter : EventKind::Leave);
        EXPECT_EQ(event.object, static_cast<ObjectId>(i / 2));
        const double metres = places[i / 2] + (i % 2 == 0 ? -0.02 : 0.02);
        const double usPerTolerance = 1e-4 / 0.6 * static_cast<double>(motionUs);
        EXPECT_NEAR(microsecondsAfter(0, event.time), metres / 0.6 * static_cast<double>(motionUs),
                    2.0 * usPerTolerance);
      }
    }
  }
}

// Two who touch on and off, and a third far away whose clock cuts their motions into many windows.
TEST(FollowedMotions, LooksOncePerMotionWhateverCutsTime) {
  EventCounters alone, beside;
  std::size_t differ = 0, events = 0;
  for (int i = 0; i < 20; ++i) {
    std::string kinds[2];
    for (const bool hasThird : {false, true}) {
      Random random(static_cast<std::uint64_t>(i));
      World world = World::build(std::nullopt).value();
      for (int k = 0; k < 2; ++k) {
        test::Walker walker = test::randomWalker(random, random.inBox(0.1), 0.1);
        const BodyId body = world.add(walker.avatar).value();
        for (std::int64_t us = 0; us <= 100 * kMs; us += (k == 0 ? 20 : 25) * kMs) {
          ASSERT_TRUE(world.push(body, us, walker.pose).ok());
          walker.step(random);
        }
      }
      if (hasThird) stand(world, world.add(ball(0.1)).value(), at(50), 100 * kMs, kMs / 4);
      const Followed told = follow(world, 100 * kMs);
      (hasThird ? beside : alone).add(told.counters);
      kinds[hasThird ? 1 : 0] = told.kinds;
      events += told.events.size();
    }
    differ += kinds[0] == kinds[1] ? 0 : 1;
  }
  EXPECT_GT(events, 100u);
  EXPECT_LE(differ, 1u);  // where two only graze the tolerance, each window may find it its way
  EXPECT_GT(alone.contactLooks, 300u);
  EXPECT_GT(beside.windows, 3 * alone.windows);
  EXPECT_LE(beside.contactLooks, alone.contactLooks * 11 / 10);
  EXPECT_LE(beside.stretches, alone.stretches * 11 / 10);
}

// Thirty balls whose boxes the other one's box meets, and one that is deep in it: that one is tried
// first on every motion.
TEST(FollowedMotions, BeginWithWhatHeldThemTogetherLast) {
  constexpr int kBeside = 30, kMotions = 40;
  std::vector<Lss> balls;
  for (int i = 0; i < kBeside; ++i) {
    const Vector3d beside(0.08 + 1e-4 * i, 0.08, 0);
    balls.push_back({beside, beside, 0.05});
  }
  balls.push_back({Vector3d(0, 0, 0.02), Vector3d(0, 0, 0.02), 0.05});
  World world = World::build(std::nullopt).value();
  const BodyId many = world.add(bodyOf(balls)).value(), one = world.add(ball(0.05)).value();
  for (int k = 0; k <= kMotions; ++k) {
    const std::int64_t us = 10 * kMs * k;
    ASSERT_TRUE(world.push(many, us, at(k % 2 == 0 ? 0.0 : 0.001)).ok());
    ASSERT_TRUE(world.push(one, us, at(0)).ok());
  }
  const Followed told = follow(world, 10 * kMs * kMotions);
  EXPECT_EQ(told.kinds, "starts_inside ");
  EXPECT_GE(told.counters.pairs, 1u * kMotions + kBeside);
  EXPECT_LE(told.counters.pairs, 2u * kMotions + 4 * kBeside);
}

// Two needles that cross and slide along each other for two seconds: no call traces all of it.
TEST(FollowedMotions, TraceLongOnesInParts) {
  World world = World::build(std::nullopt, {1e-5}).value();
  const BodyId lying = world.add(bodyOf({{Vector3d(0, 0, 0), Vector3d(1, 0, 0), 0.0}})).value();
  const BodyId sliding = world.add(bodyOf({{Vector3d(0, 0, -1), Vector3d(0, 0, 1), 0.0}})).value();
  stand(world, world.add(ball(0.1)).value(), at(50), 2'000 * kMs, kMs);
  stand(world, lying, at(0), 2'000 * kMs, 2'000 * kMs);
  ASSERT_TRUE(world.push(sliding, 0, at(-0.1)).ok());
  ASSERT_TRUE(world.push(sliding, 2'000 * kMs, at(0.9)).ok());
  WorldFollower follower = WorldFollower::start(0).value();
  WorldEvents answer;
  std::uint64_t most = 0, all = 0, calls = 0;
  for (std::int64_t us = 5 * kMs; us <= 2'000 * kMs; us += 5 * kMs) {
    ASSERT_TRUE(follower.follow(world, us, answer).ok());
    most = std::max(most, answer.counters.contactLooks);
    all += answer.counters.contactLooks;
    calls += answer.counters.contactLooks > 0 ? 1 : 0;
  }
  EXPECT_EQ(follower.open().size(), 1u);
  EXPECT_GT(all, 10'000u);
  EXPECT_LT(most, all / 10);
  EXPECT_GE(calls, 18u);
  EXPECT_LE(calls, 21u);
}

// A ball would leave the wall at 15 ms, but somebody takes it at 10 ms and holds it where it is.
TEST(FollowedMotions, EndWhereSomebodyIsTaken) {
  World world = World::build(std::nullopt).value();
  const BodyId wall = world.add(ball(0.1)).value(), taken = world.add(ball(0.1)).value();
  const BodyId hand = world.add(ball(0.1)).value(), clock = world.add(ball(0.1)).value();
  stand(world, wall, at(0.0), 40 * kMs, 40 * kMs);
  stand(world, hand, at(9.0), 40 * kMs, 40 * kMs);
  stand(world, clock, at(50.0), 40 * kMs, kMs);
  ASSERT_TRUE(world.push(taken, 0, at(0.05)).ok());
  ASSERT_TRUE(world.push(taken, 20 * kMs, at(0.25)).ok());
  WorldFollower follower = WorldFollower::start(0).value();
  WorldEvents answer;
  ASSERT_TRUE(follower.follow(world, 5 * kMs, answer).ok());
  ASSERT_EQ(answer.events.size(), 1u);
  EXPECT_EQ(answer.events[0].kind, EventKind::StartsInside);
  // Where it is at 10 ms: 15 cm from the wall's middle.
  ASSERT_TRUE(world.attach(taken, {hand, 0}, 10 * kMs, at(0.15 - 9.0)).ok());
  for (std::int64_t us = 6 * kMs; us <= 40 * kMs; us += kMs) {
    ASSERT_TRUE(follower.follow(world, us, answer).ok());
    EXPECT_TRUE(answer.events.empty()) << us;
    EXPECT_EQ(follower.open().size(), 1u);
  }
}

// They part between two poses, far from the origin. A clock cuts that motion, and doubles do not
// tell its parts: no part of it says that they leave.
TEST(FollowedMotions, SayNothingInsideWhatIsUnresolved) {
  constexpr double kFar = 9e6;
  WorldOptions options;
  options.tolerance = 1e-7;
  World world = World::build(std::nullopt, options).value();
  const BodyId wall = world.add(ball(0.1)).value(), carried = world.add(ball(0.1)).value();
  const BodyId hand = world.add(ball(0.1)).value(), clock = world.add(ball(0.1)).value();
  for (const int i : {0, 10, 40}) {
    ASSERT_TRUE(world.push(wall, i * kMs, at(kFar)).ok());
    ASSERT_TRUE(world.push(hand, i * kMs, at(kFar + (i < 40 ? 1.0 : 1.6))).ok());
  }
  stand(world, clock, at(kFar + 50.0), 40 * kMs, 10 * kMs);
  ASSERT_TRUE(world.attach(carried, {hand, 0}, 0, at(0.15 - 1.0)).ok());
  WorldFollower follower = WorldFollower::start(0).value();
  WorldEvents answer;
  ASSERT_TRUE(follower.follow(world, 40 * kMs, answer).ok());
  // The two bodies altogether, and what was in contact; boxes tell that they are apart later.
  ASSERT_EQ(answer.events.size(), 5u);
  EXPECT_EQ(answer.events[0].kind, EventKind::StartsInside);
  for (const int i : {1, 2, 3, 4}) {
    const WorldEvent& event = answer.events[i];
    EXPECT_EQ(event.kind, i < 3 ? EventKind::UnresolvedFrom : EventKind::UnresolvedTo);
    EXPECT_EQ(event.reason, UndecidedReason::Resolution);
    EXPECT_EQ(event.time.us, (i < 3 ? 10 : 20) * kMs);
    EXPECT_EQ(event.a.link, i % 2 == 1 ? kEveryLink : 0);
  }
  EXPECT_TRUE(follower.open().empty());
}

// Carried past somebody and let go of within a motion that was looked at to its end: it comes back,
// as nobody knew.
TEST(FollowedMotions, SayNothingOfThoseThatBeginLater) {
  World world = World::build(std::nullopt).value();
  const BodyId carrying = world.add(ball(0.01)).value(), carried = world.add(ball(0.01)).value();
  stand(world, world.add(ball(0.01)).value(), at(0.1), 40 * kMs, 40 * kMs);
  ASSERT_TRUE(world.push(carrying, 0, at(0, 1)).ok());
  ASSERT_TRUE(world.push(carrying, 40 * kMs, at(0.8, 1)).ok());
  ASSERT_TRUE(world.attach(carried, {carrying, 0}, 0, at(0, -1)).ok());
  ASSERT_TRUE(world.detach(carried, 20 * kMs, at(0.4)).ok());
  ASSERT_TRUE(world.push(carried, 40 * kMs, at(-0.4)).ok());
  EXPECT_EQ(follow(world, 40 * kMs).kinds, "enter leave enter leave ");
}

/// Follows until 10 ms and until 40 ms; in between somebody says what was at 0.
template <typename Say>
std::string followSaying(World& world, const Say& say) {
  WorldFollower follower = WorldFollower::start(0).value();
  std::string kinds;
  for (const std::int64_t us : {10 * kMs, 40 * kMs}) {
    WorldEvents answer;
    const auto done = follower.follow(world, us, answer);
    EXPECT_TRUE(done.ok()) << describe(done.error());
    for (const WorldEvent& event : answer.events) kinds += std::string(toString(event.kind)) + " ";
    if (us == 10 * kMs) say();
  }
  return kinds;
}

// A change that is said late, for the very instant at which the motion began: from the pose that is
// known on, everything about that motion is another one's.
TEST(FollowedMotions, SayNothingOfWhomAnotherCarriedSinceTheirBegin) {
  World world = World::build(std::nullopt).value();
  const BodyId flying = world.add(ball(0.01)).value(), carrier = world.add(ball(0.01)).value();
  const BodyId post = world.add(ball(0.01)).value();
  for (const std::int64_t us : {-20 * kMs, std::int64_t{0}, 40 * kMs}) {
    ASSERT_TRUE(world.push(post, us, at(0.0)).ok());
    ASSERT_TRUE(world.push(flying, us, at(us > 0 ? 1.0 : 0.015)).ok());  // it leaves at once
    ASSERT_TRUE(world.push(carrier, us, at(us > 0 ? -1.0 : 1.0, 1)).ok());
  }
  stand(world, world.add(ball(0.01)).value(), at(50), 40 * kMs, 10 * kMs);
  const std::string kinds = followSaying(world, [&] {
    ASSERT_TRUE(world.attach(flying, {carrier, 0}, 0, at(0, -1)).ok());
  });
  EXPECT_EQ(kinds, "starts_inside leave enter leave ");  // at 20 ms
}

TEST(FollowedMotions, SayNothingOfWhoWasLetGoOfAtTheirBegin) {
  World world = World::build(std::nullopt).value();
  const BodyId carrier = world.add(ball(0.01)).value(), carried = world.add(ball(0.01)).value();
  const BodyId post = world.add(ball(0.01)).value();
  for (const std::int64_t us : {-20 * kMs, std::int64_t{0}, 40 * kMs}) {
    ASSERT_TRUE(world.push(post, us, at(0.0)).ok());
    ASSERT_TRUE(world.push(carrier, us, at(us > 0 ? 1.0 : 0.015, 1)).ok());
  }
  ASSERT_TRUE(world.attach(carried, {carrier, 0}, -20 * kMs, at(0, -1)).ok());
  stand(world, world.add(ball(0.01)).value(), at(50), 40 * kMs, 10 * kMs);
  const std::string kinds = followSaying(world, [&] {
    ASSERT_TRUE(world.detach(carried, 0, at(1.0)).ok());
    ASSERT_TRUE(world.push(carried, 40 * kMs, at(-1.0)).ok());
  });
  EXPECT_EQ(kinds, "starts_inside leave enter leave ");
}

// A limb that lies over hundreds of triangles, 2 mm above them, while its heel is on the floor: all
// are as near throughout, and to cut the time would be to look at each in each part.
TEST(FollowedMotions, SearchAmongManyTrianglesInFewLooks) {
  constexpr int kPerRow = 200, kRows = 4;
  World world = World::build(gravel(kPerRow, kRows, -0.02)).value();
  const std::vector<Lss> leg = {{Vector3d(-0.8, 0.0205, 0.008), Vector3d(0.8, 0.0235, 0.008), 0.02},
                                {Vector3d(0.9, -0.01, 0), Vector3d(0.95, -0.01, 0), 0.02}};
  const BodyId limb = world.add(bodyOf(leg)).value();
  for (const int k : {0, 1, 2}) ASSERT_TRUE(world.push(limb, 10 * kMs * k, at(1e-4 * k)).ok());
  const Followed told = follow(world, 20 * kMs);
  EXPECT_EQ(told.kinds, "starts_inside ");
  EXPECT_GT(told.counters.pairs, 1u * kPerRow * kRows);
  EXPECT_LE(told.counters.pairs, 6u * kPerRow * kRows);
}

// The same beside a slope: what a box around the limb holds is not near the limb.
TEST(FollowedMotions, LeaveOutWhatOnlyTheBoxHolds) {
  World world = World::build(gravel(100, 100, std::nullopt)).value();
  // It touches a corner of the gravel, and rises from there across all of it.
  const BodyId limb =
      world.add(bodyOf({{Vector3d(0, 0.01, 0), Vector3d(0.4, 0.35, 0.4), 0.02}})).value();
  for (const int k : {0, 1, 2}) ASSERT_TRUE(world.push(limb, 10 * kMs * k, at(1e-4 * k)).ok());
  const Followed told = follow(world, 20 * kMs);
  EXPECT_EQ(told.kinds, "starts_inside ");
  EXPECT_LE(told.counters.pairs, 2'000u);
}

}  // namespace
}  // namespace foretouch
