// What a follower tells of worlds whose events are known, what it refuses, and that it always tells
// the same.
#include "middleware/events/world_follower.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/worker_pool.h"
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

/// Squares of 2 m across x, each an object of its own or all one.
Scene sheets(const std::vector<double>& places, bool areOne) {
  RawScene raw;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = places[i];
    if (i == 0 || !areOne) raw.objectNames.push_back("sheet " + std::to_string(i));
    raw.triangles.push_back({{Vector3d(x, -1, -1), Vector3d(x, 1, -1), Vector3d(x, 1, 1)}});
    raw.triangles.push_back({{Vector3d(x, -1, -1), Vector3d(x, 1, 1), Vector3d(x, -1, 1)}});
    const auto object = static_cast<ObjectId>(raw.objectNames.size() - 1);
    raw.objectOf.insert(raw.objectOf.end(), {object, object});
  }
  return Scene::build(std::move(raw)).value();
}

World worldOf(std::optional<Scene> still = std::nullopt) {
  return World::build(std::move(still)).value();
}
WorldFollower followerFrom(std::int64_t fromUs, const FollowOptions& options = {}) {
  return WorldFollower::start(fromUs, options).value();
}
BodyOptions holdingStill() {
  BodyOptions options;
  options.whenSilent = WhenSilent::HoldStill;
  return options;
}

WorldEvents followed(WorldFollower& follower, const World& world, std::int64_t untilUs) {
  WorldEvents answer;
  const auto done = follower.follow(world, untilUs, answer);
  EXPECT_TRUE(done.ok()) << describe(done.error());
  return answer;
}
std::string kindsOf(const WorldEvents& answer) {
  std::string kinds;
  for (const WorldEvent& event : answer.events) kinds += std::string(toString(event.kind)) + " ";
  return kinds;
}

// Who is looked at again touches since nobody knows when; who was free before enters.
TEST(WorldFollower, WhatTouchesWhereGroupsAreAskedAgainStartsInside) {
  World world = worldOf(sheets({0.05}, false));
  const BodyId one = world.add(ball(0.1)).value(), other = world.add(ball(0.1)).value();
  for (const int i : {0, 1, 2, 3}) {
    ASSERT_TRUE(world.push(one, 10'000 * i, at(0.0)).ok());
    ASSERT_TRUE(world.push(other, 10'000 * i, at(0.0, 0.15)).ok());
  }
  WorldFollower follower = followerFrom(0);
  const auto ask = [&](bool isAsked) {
    ASSERT_TRUE(world.ask(0, 0, isAsked).ok());
    ASSERT_TRUE(world.askStill(0, isAsked).ok());
  };
  ask(false);
  EXPECT_EQ(kindsOf(followed(follower, world, 10'000)), "");
  ask(true);
  EXPECT_EQ(kindsOf(followed(follower, world, 30'000)),
            "starts_inside starts_inside starts_inside ");
}

// Two balls of 10 cm; one flies through the other at 10 m/s: they touch from 80 ms to 120 ms.
TEST(WorldFollower, TellsWhenWhereAndHowHardTwoMeet) {
  World world = worldOf();
  const BodyId one = world.add(ball(0.1)).value(), other = world.add(ball(0.1)).value();
  for (const int i : {0, 1, 2, 3, 4}) {
    ASSERT_TRUE(world.push(one, 50'000 * i, at(0.5 * i)).ok());
    ASSERT_TRUE(world.push(other, 50'000 * i, at(1.0)).ok());
  }
  WorldFollower follower = followerFrom(0);
  const Mass ofOne = massOf({Vector3d::Zero(), Vector3d::Zero(), 0.1}, 1000.0);
  ASSERT_TRUE(follower.weigh(one, ofOne).ok());
  WorldEvents answer = followed(follower, world, 100'000);
  ASSERT_EQ(kindsOf(answer), "enter ");
  const WorldEvent enter = answer.events[0];
  EXPECT_EQ(enter.a.body, one);
  EXPECT_EQ(enter.b.body, other);
  const double enterUs = microsecondsAfter(0, enter.time);
  EXPECT_LE(enterUs, 80'000.0);
  EXPECT_GE(enterUs, 80'000.0 - 100.0 - 1e-6);  // a tolerance takes 100 us
  EXPECT_NEAR((enter.velocity_W - Vector3d(10, 0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((enter.nhat_BA_W - Vector3d(-1, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_LE(enter.approachLower, 10.0);
  EXPECT_GE(enter.approachUpper, 10.0);
  EXPECT_NEAR(enter.approachUpper, enter.approachLower, 1e-6);
  EXPECT_NEAR(enter.effectiveMass, ofOne.kg, 1e-9);
  EXPECT_NEAR(enter.b.p_W.x(), 0.9, 1e-12);
  EXPECT_EQ(enter.numPoints, 1u);
  ASSERT_EQ(answer.parts.size(), 1u);
  EXPECT_TRUE(answer.parts[0].goesOn);
  ASSERT_EQ(follower.open().size(), 1u);
  EXPECT_EQ(follower.followedUntilUs(), 100'000);

  answer = followed(follower, world, 200'000);
  ASSERT_EQ(kindsOf(answer), "leave ");
  const WorldEvent& leave = answer.events[0];
  const double leaveUs = microsecondsAfter(0, leave.time);
  EXPECT_GE(leaveUs, 120'000.0);
  EXPECT_LE(leaveUs, 120'000.0 + 200.0 + 1e-6);
  EXPECT_TRUE(leave.since == enter.time);
  EXPECT_EQ(leave.cause, LeaveCause::Apart);
  EXPECT_LT(leave.approachSpeed, 0.0);
  ASSERT_EQ(answer.parts.size(), 1u);
  EXPECT_TRUE(answer.parts[0].beganBefore);
  EXPECT_FALSE(answer.parts[0].goesOn);
  EXPECT_TRUE(follower.open().empty());
}

// The same ball twice is twice the pairs, looked at in the same instants.
TEST(WorldFollower, CountsInstantsAndNotThePairsLookedAtInThem) {
  const auto countersOf = [](const Avatar& standing) {
    World world = worldOf();
    const BodyId one = world.add(ball(0.1)).value(), other = world.add(standing).value();
    for (const int i : {0, 1, 2}) {
      EXPECT_TRUE(world.push(one, 100'000 * i, at(i == 1 ? 2.0 : 0.0, 0.05)).ok());
      EXPECT_TRUE(world.push(other, 100'000 * i, at(1.0)).ok());
    }
    WorldFollower follower = followerFrom(0);
    const WorldEvents answer = followed(follower, world, 200'000);
    EXPECT_EQ(kindsOf(answer), "enter leave enter leave ");
    return answer.counters;
  };
  const Lss lss{Vector3d::Zero(), Vector3d::Zero(), 0.1};
  const EventCounters once = countersOf(bodyOf({lss})), twice = countersOf(bodyOf({lss, lss}));
  EXPECT_EQ(twice.freeLooks, once.freeLooks);
  EXPECT_EQ(twice.contactLooks, once.contactLooks);
  EXPECT_GT(twice.pairs, once.pairs);
  EXPECT_GT(once.freeLooks, 2u);
}

// A ball passes them within one motion, and each of them is entered and left.
TEST(WorldFollower, TellsEveryThinSheet) {
  const std::vector<double> places = {0.1, 0.2, 0.3, 0.4, 0.5};
  for (const bool isStill : {true, false}) {
    for (const bool areOne : {true, false}) {
      World world = isStill ? worldOf(sheets(places, areOne)) : worldOf();
      const BodyId flying = world.add(ball(0.01)).value();
      if (!isStill) {
        const BodyId mesh = world.add(sheets(places, areOne)).value();
        ASSERT_TRUE(world.push(mesh, 0, at(0.0)).ok());
        ASSERT_TRUE(world.push(mesh, 7'000, at(0.0)).ok());
        ASSERT_TRUE(world.push(mesh, 20'000, at(0.0)).ok());
      }
      ASSERT_TRUE(world.push(flying, 0, at(0.0)).ok());
      ASSERT_TRUE(world.push(flying, 10'000, at(0.6)).ok());
      WorldFollower follower = followerFrom(0);
      const WorldEvents answer = followed(follower, world, 10'000);
      std::string expected;
      for (std::size_t i = 0; i < places.size(); ++i) expected += "enter leave ";
      EXPECT_EQ(kindsOf(answer), expected);
      ASSERT_EQ(answer.events.size(), 10u);
      EXPECT_EQ(answer.events[8].object, areOne ? 0 : 4);
      EXPECT_EQ(answer.parts.size(), 5u);
    }
  }
}

// The ball lies in one sheet when it is driven into the other: neither hides the other.
TEST(WorldFollower, TellsEachObjectByItself) {
  World world = worldOf(sheets({0.0, 0.3}, false));
  const BodyId body = world.add(bodyOf({{Vector3d::Zero(), Vector3d(0.2, 0, 0), 0.01}})).value();
  ASSERT_TRUE(world.push(body, 0, at(-0.1)).ok());
  ASSERT_TRUE(world.push(body, 10'000, at(0.15)).ok());  // through both, then out of the first
  WorldFollower follower = followerFrom(0);
  const WorldEvents answer = followed(follower, world, 10'000);
  EXPECT_EQ(kindsOf(answer), "starts_inside leave enter ");
  EXPECT_EQ(answer.events[0].object, 0);
  EXPECT_EQ(answer.events[1].object, 0);
  EXPECT_EQ(answer.events[2].object, 1);
  EXPECT_NEAR(microsecondsAfter(0, answer.events[1].time), 110.0 / 250.0 * 10'000.0, 200.0);
  EXPECT_TRUE(std::isinf(answer.events[2].effectiveMass));
}

// What stays in deep contact costs some looks per pose, whatever the tolerance.
TEST(WorldFollower, FollowsADeepContactInFewLooks) {
  World world = World::build(sheets({0.0}, true), {1e-7}).value();
  // A needle without radius that slides along itself.
  const BodyId body =
      world.add(bodyOf({{Vector3d(-0.5, 0, 0), Vector3d(0.5, 0.1, 0), 0.0}})).value();
  for (const int i : {0, 1, 2}) {
    ASSERT_TRUE(world.push(body, 10'000 * i, at(0.1 * i, 0.01 * i)).ok());
  }
  WorldFollower follower = followerFrom(0);
  const WorldEvents answer = followed(follower, world, 20'000);
  EXPECT_EQ(kindsOf(answer), "starts_inside ");
  EXPECT_LE(answer.counters.contactLooks, 20u);  // by tolerances: a million
}

TEST(WorldFollower, ClaimsNothingOfWhomNobodyKnows) {
  World world = worldOf();
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId still = world.add(ball(0.1)).value();
  const BodyId lost = world.add(ball(0.1), undecided).value();
  for (const int i : {0, 1, 2, 3, 4, 5}) {
    ASSERT_TRUE(world.push(still, 10'000 * i, at(0.0)).ok());
  }
  ASSERT_TRUE(world.push(lost, 0, at(0.15)).ok());
  ASSERT_TRUE(world.push(lost, 10'000, at(0.15)).ok());
  WorldFollower follower = followerFrom(0);
  WorldEvents answer = followed(follower, world, 30'000);
  EXPECT_EQ(kindsOf(answer), "starts_inside unresolved_from unresolved_from ");
  ASSERT_EQ(answer.events.size(), 3u);
  EXPECT_EQ(answer.events[1].b.body, lost);
  EXPECT_EQ(answer.events[2].b.body, kEveryBody);
  EXPECT_EQ(answer.events[2].a.body, lost);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(answer.events[i].time.us, 10'000);
    EXPECT_EQ(answer.events[i].reason, UndecidedReason::Gap);
  }
  ASSERT_EQ(answer.silent.size(), 1u);
  // He is back, and was on the way all the time.
  ASSERT_TRUE(world.push(lost, 50'000, at(0.15)).ok());
  answer = followed(follower, world, 50'000);
  EXPECT_EQ(kindsOf(answer), "unresolved_to unresolved_to starts_inside ");
  EXPECT_EQ(answer.events[0].time.us, 30'000);
  EXPECT_EQ(answer.events[2].time.us, 30'000);
  EXPECT_EQ(follower.open().size(), 1u);
}

// A contact that began while all was known, and goes on with somebody who is silent.
TEST(WorldFollower, SaysWhatRestsOnWhoIsTakenToHoldStill) {
  for (const std::int64_t cutUs : {0, 15'000, 100'000}) {
    World world = worldOf();
    const BodyId seen = world.add(ball(0.1)).value();
    const BodyId silent = world.add(ball(0.1), holdingStill()).value();
    for (const int i : {0, 1, 2, 3}) {
      ASSERT_TRUE(world.push(seen, 50'000 * i, at(i < 3 ? 0.0 : 9.0)).ok());
    }
    for (const int i : {0, 1}) ASSERT_TRUE(world.push(silent, 10'000 * i, at(0.15)).ok());
    FollowOptions options;
    options.cutUs = cutUs;
    WorldFollower follower = WorldFollower::start(0, options).value();
    WorldEvents answer;
    if (cutUs == 0) {
      answer = followed(follower, world, 10'000);
      ASSERT_EQ(follower.open().size(), 1u);
      EXPECT_FALSE(follower.open()[0].isAssumed);
      EXPECT_FALSE(answer.parts.at(0).isAssumed);
    }
    answer = followed(follower, world, cutUs == 0 ? 60'000 : 100'000);
    EXPECT_EQ(kindsOf(answer), cutUs == 0 ? "" : "starts_inside ");
    ASSERT_EQ(answer.parts.size(), 1u);
    EXPECT_TRUE(answer.parts[0].isAssumed);
    ASSERT_EQ(follower.open().size(), 1u);
    EXPECT_TRUE(follower.open()[0].isAssumed);
    if (cutUs != 0) continue;
    // It rested on that, whatever is known when it ends.
    answer = followed(follower, world, 150'000);
    EXPECT_EQ(kindsOf(answer), "leave ");
    ASSERT_EQ(answer.parts.size(), 1u);
    EXPECT_TRUE(answer.parts[0].isAssumed);
  }
}

TEST(WorldFollower, EndsWhatIsNotAskedAnyMore) {
  World world = worldOf();
  const BodyId hand = world.add(ball(0.1)).value(), cup = world.add(ball(0.1)).value();
  for (const int i : {0, 1, 2, 3, 4}) ASSERT_TRUE(world.push(hand, 10'000 * i, at(0.0)).ok());
  for (const int i : {0, 1, 2, 3}) ASSERT_TRUE(world.push(cup, 10'000 * i, at(0.15)).ok());
  ASSERT_TRUE(world.attach(cup, {hand, 0}, 25'000, at(0.15)).ok());
  ASSERT_TRUE(world.detach(cup, 35'000, at(0.15)).ok());
  ASSERT_TRUE(world.push(cup, 40'000, at(0.5)).ok());
  // At every change, all between two cuts, and all from the begin on.
  for (const std::int64_t cutUs : {0, 20'000, 40'000}) {
    FollowOptions options;
    options.cutUs = cutUs;
    WorldFollower follower = followerFrom(0, options);
    const WorldEvents answer = followed(follower, world, 40'000);
    ASSERT_EQ(kindsOf(answer), "starts_inside leave starts_inside leave ") << cutUs;
    EXPECT_EQ(answer.events[1].cause, LeaveCause::NotAsked);
    EXPECT_EQ(answer.events[1].time.us, 25'000);
    EXPECT_NEAR(answer.events[1].penetration, 0.05, 1e-12);
    EXPECT_NEAR((answer.events[1].a.p_W - Vector3d(0.1, 0, 0)).norm(), 0.0, 1e-12);
    EXPECT_EQ(answer.events[2].time.us, 35'000);
    EXPECT_EQ(answer.events[3].cause, LeaveCause::Apart);
  }
}

// A ball lies in two sheets and slides; a hand takes it 3 m away, and swings it back into the
// first.
TEST(WorldFollower, TellsWhereWhoIsPutElsewhereWasLast) {
  for (const std::int64_t cutUs : {0, 30'000, 100'000, 300'000}) {
    for (const bool forgets : {false, true}) {
      World world = worldOf(sheets({0.0, 0.05}, false));
      const BodyId hand = world.add(ball(0.1)).value(), cup = world.add(ball(0.1)).value();
      ASSERT_TRUE(world.push(hand, 0, at(3.0, 5.0)).ok());
      ASSERT_TRUE(world.push(hand, 100'000, at(3.0, 5.0)).ok());
      ASSERT_TRUE(world.push(hand, 300'000, at(0.0, 5.0)).ok());
      ASSERT_TRUE(world.push(cup, 0, at(0.02, 0.0)).ok());
      ASSERT_TRUE(world.push(cup, 150'000, at(0.02, 0.3)).ok());
      ASSERT_TRUE(world.attach(cup, {hand, 0}, 100'000, at(0.0, -5.0)).ok());
      FollowOptions options;
      options.cutUs = cutUs;
      WorldFollower follower = followerFrom(0, options);
      std::vector<WorldEvent> events;
      for (const std::int64_t us : {100'000, 300'000}) {
        const WorldEvents answer = followed(follower, world, us);
        events.insert(events.end(), answer.events.begin(), answer.events.end());
        if (forgets) world.forgetBefore(follower.followedUntilUs());
      }
      ASSERT_EQ(events.size(), 6u) << cutUs;
      for (int i = 0; i < 2; ++i) {
        const WorldEvent &start = events[i], &leave = events[2 + i], &enter = events[5 - i];
        EXPECT_EQ(start.kind, EventKind::StartsInside);
        EXPECT_EQ(start.object, i);
        ASSERT_EQ(leave.kind, EventKind::Leave);
        EXPECT_EQ(leave.cause, LeaveCause::Moved);
        EXPECT_EQ(leave.time.us, 100'000);
        EXPECT_EQ(leave.object, i);
        // It slides at 2 m/s; 2 cm off the one sheet, and 3 cm off the other, on its other side.
        const double sheet = 0.05 * i, off = i == 0 ? 0.02 : 0.03, side = i == 0 ? 1.0 : -1.0;
        EXPECT_NEAR((leave.b.p_W - Vector3d(sheet, 0.2, 0)).norm(), 0.0, 1e-9);
        EXPECT_NEAR((leave.a.p_W - Vector3d(0.02 - 0.1 * side, 0.2, 0)).norm(), 0.0, 1e-9);
        EXPECT_NEAR(leave.penetration, 0.1 - off, 1e-9);
        EXPECT_NEAR((leave.velocity_W - Vector3d(0, 2, 0)).norm(), 0.0, 1e-6);
        EXPECT_GE(leave.numPoints, 1u);
        // It was a metre away in between: nobody finds it inside.
        EXPECT_EQ(enter.kind, EventKind::Enter) << cutUs;
        EXPECT_EQ(enter.object, i);
      }
    }
  }
}

/// Balls that lie in one another, and shift; and a ball far from them that flies through another
/// one: the last two bodies.
World heapAndPair(int heap, std::uint64_t workPerWindow) {
  WorldOptions options;
  options.workPerWindow = workPerWindow;
  World world = World::build(std::nullopt, options).value();
  const Avatar one = ball(0.1);
  for (int i = 0; i < heap + 2; ++i) {
    const BodyId body = world.add(one).value();
    for (const int k : {0, 1, 2, 3}) {
      const double x = i < heap ? 0.001 * (i + k) : i == heap ? 10.0 : 9.7 + 0.2 * k;
      EXPECT_TRUE(
          world.push(body, 10'000 * k + (i < heap && k != 0 && k != 3 ? 10 * i : 0), at(x)).ok());
    }
  }
  return world;
}

// Whoever has too little work is told as unresolved, for as long as he has; the pair beside the
// heap is told as it is without a bound.
TEST(WorldFollower, LeavesUnresolvedWhatCostsTooMuch) {
  constexpr int kPile = 24;
  std::vector<WorldEvent> truth;
  for (const std::uint64_t work :
       {std::numeric_limits<std::uint64_t>::max(), std::uint64_t{60'000}, std::uint64_t{2'000}}) {
    for (const int threads : {1, 3}) {
      const World world = heapAndPair(kPile, work);
      FollowOptions options;
      options.cutUs = 2'000;
      options.threads = threads;
      WorldFollower follower = followerFrom(0, options);
      const WorldEvents answer = followed(follower, world, 30'000);
      std::vector<WorldEvent> beside;
      std::size_t unresolved = 0;
      for (const WorldEvent& event : answer.events) {
        if (event.a.body == kPile) beside.push_back(event);
        if (event.kind != EventKind::UnresolvedFrom) continue;
        ++unresolved;
        EXPECT_EQ(event.reason, UndecidedReason::WorkBudget);
      }
      if (truth.empty()) truth = beside;
      ASSERT_EQ(truth.size(), 2u);
      if (work > 2'000) {
        ASSERT_EQ(beside.size(), 2u) << work;
        for (int i = 0; i < 2; ++i) {
          EXPECT_EQ(beside[i].kind, truth[i].kind);
          EXPECT_TRUE(beside[i].time == truth[i].time);
        }
      }
      EXPECT_EQ(unresolved > 0, work <= 60'000) << work;
      // All pairs of the heap touch throughout: nothing between their parts is free.
      for (BodyId a = 0; a < kPile; ++a) {
        for (BodyId b = a + 1; b < kPile; ++b) {
          WorldTime covered{0, 0.0};
          for (bool goesOn = true; goesOn && covered < WorldTime{30'000, 0.0};) {
            goesOn = false;
            for (const WorldPart& part : answer.parts) {
              if (part.a.body != a || part.b.body != b) continue;
              if (covered < part.from || !(covered < part.to)) continue;
              covered = part.to;
              goesOn = true;
            }
          }
          ASSERT_FALSE(covered < (WorldTime{30'000, 0.0}))
              << a << " and " << b << ", work " << work;
        }
      }
    }
  }
}

// Along a row of balls, which it touches to the end: where the work ends, the contact is lost.
TEST(WorldFollower, AContactThatIsLostIsNotLeft) {
  std::vector<Lss> row;
  for (int i = 0; i < 40; ++i) {
    row.push_back({Vector3d(0.1 * i, 0, 0), Vector3d(0.1 * i, 0, 0), 0.1});
  }
  int lost = 0;
  for (double work = 1.0; work < 1e6; work *= 1.2) {
    WorldOptions options;
    options.workPerPair = static_cast<std::uint64_t>(work);
    World world = World::build(std::nullopt, options).value();
    const BodyId one = world.add(ball(0.1)).value(), other = world.add(bodyOf(row)).value();
    for (const int i : {0, 1}) {
      ASSERT_TRUE(world.push(one, 100'000 * i, at(-1.0 + 4.0 * i, 0.15)).ok());
      ASSERT_TRUE(world.push(other, 100'000 * i, at(0.0)).ok());
    }
    WorldFollower follower = followerFrom(0);
    const std::string kinds = kindsOf(followed(follower, world, 100'000));
    EXPECT_EQ(kinds.find("leave"), std::string::npos) << work << ": " << kinds;
    lost += kinds == "enter unresolved_from " ? 1 : 0;
  }
  EXPECT_GT(lost, 0);
}

// With a few units of work nobody is looked at; when the budget is for more, what touches starts
// inside: nobody saw it enter.
TEST(WorldFollower, FindsInsideWhomItHadGivenUp) {
  WorldOptions options;
  options.workPerWindow = 3'000;
  World world = World::build(std::nullopt, options).value();
  const Avatar one = ball(0.1);
  // Two that come to touch at 8 ms, beside a heap that leaves at 20 ms.
  for (int i = 0; i < 20; ++i) {
    const BodyId body = world.add(one).value();
    const bool isHeap = i > 1;
    for (const int k : {0, 1, 2, 3, 4}) {
      double x = i == 0 ? 0.0 : 0.3 - 0.05 * k;
      if (isHeap) x = k < 2 ? 0.11 : 5.0 + i;
      ASSERT_TRUE(world.push(body, 10'000 * k, at(x, isHeap && k < 2 ? 0.05 : 0.0)).ok());
    }
  }
  WorldFollower follower = followerFrom(0);
  const WorldEvents answer = followed(follower, world, 40'000);
  std::string kinds;
  for (const WorldEvent& event : answer.events) {
    if (event.a.body == 0 && event.b.body == 1) kinds += std::string(toString(event.kind)) + " ";
  }
  EXPECT_EQ(kinds, "unresolved_from unresolved_to starts_inside ");
}

// It leaves the one before it enters the other, which are a millimetre apart.
TEST(WorldFollower, TellsEventsInTheirTrueOrder) {
  World world = worldOf();
  const BodyId flying = world.add(ball(0.05)).value();
  const BodyId right = world.add(ball(0.05)).value(), left = world.add(ball(0.05)).value();
  for (const BodyId body : {right, left}) {
    ASSERT_TRUE(world.push(body, 0, at(body == right ? 0.205 : 0.0)).ok());
    ASSERT_TRUE(world.push(body, 30'000, at(body == right ? 0.205 : 0.0)).ok());
  }
  ASSERT_TRUE(world.push(flying, 0, at(0.0, 0.0)).ok());
  ASSERT_TRUE(world.push(flying, 30'000, at(0.2, 0.0)).ok());
  WorldFollower follower = followerFrom(0);
  const WorldEvents answer = followed(follower, world, 30'000);
  ASSERT_EQ(kindsOf(answer), "starts_inside leave enter ");
  EXPECT_EQ(answer.events[1].b.body, left);
  EXPECT_EQ(answer.events[2].b.body, right);
}

/// A world in which much happens, pushed by body or by instant.
World lively(bool isByBody) {
  World world = worldOf(sheets({-0.1, 0.2}, false));
  struct Entry {
    BodyId body;
    std::int64_t us;
    Pose pose;
  };
  std::vector<Entry> entries;
  for (int k = 0; k < 8; ++k) {
    Random random(static_cast<std::uint64_t>(k));
    test::Walker walker = test::randomWalker(random, random.inBox(0.4), 0.1);
    BodyOptions options;
    if (const auto rules = PairRules::derive(walker.avatar); rules.ok()) {
      options.self = rules.value();
    }
    const BodyId body = world.add(walker.avatar, options).value();
    const std::int64_t periodUs = test::randomPeriod(random);
    for (std::int64_t us = 0; us < 100'000 + periodUs; us += periodUs) {
      entries.push_back({body, us, walker.pose});
      walker.step(random);
    }
  }
  if (!isByBody) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& x, const Entry& y) { return x.us < y.us; });
  }
  for (const Entry& entry : entries) {
    EXPECT_TRUE(world.push(entry.body, entry.us, entry.pose).ok());
  }
  return world;
}

std::vector<WorldEvent> eventsOf(const World& world, const FollowOptions& options,
                                 const std::vector<std::int64_t>& untils) {
  WorldFollower follower = followerFrom(0, options);
  std::vector<WorldEvent> events;
  for (const std::int64_t untilUs : untils) {
    const WorldEvents answer = followed(follower, world, untilUs);
    events.insert(events.end(), answer.events.begin(), answer.events.end());
  }
  return events;
}

bool areSameBits(const WorldEvent& x, const WorldEvent& y) {
  const auto same = [](const auto& p, const auto& q) {
    return std::memcmp(&p, &q, sizeof(p)) == 0;
  };
  const auto sameSide = [&](const ContactSide& p, const ContactSide& q) {
    return p.body == q.body && p.link == q.link && p.lss == q.lss && p.triangle == q.triangle &&
           same(p.p_W, q.p_W);
  };
  bool is = x.kind == y.kind && x.time == y.time && x.since == y.since && sameSide(x.a, y.a) &&
            sameSide(x.b, y.b) && x.object == y.object && same(x.separation, y.separation) &&
            same(x.penetration, y.penetration) && same(x.nhat_BA_W, y.nhat_BA_W) &&
            same(x.velocity_W, y.velocity_W) && same(x.approachLower, y.approachLower) &&
            same(x.approachUpper, y.approachUpper) && x.numPoints == y.numPoints;
  for (std::size_t i = 0; is && i < x.numPoints; ++i) {
    is = same(x.points[i].p_WA, y.points[i].p_WA) && same(x.points[i].p_WB, y.points[i].p_WB);
  }
  return is;
}

TEST(WorldFollower, TellsTheSameForAnyThreadsOrdersAndCalls) {
  const World world = lively(true), again = lively(false);
  for (const std::int64_t cutUs : {0, 5'000}) {
    FollowOptions options;
    options.cutUs = cutUs;
    const auto once = eventsOf(world, options, {100'000});
    ASSERT_GT(once.size(), 50u);
    FollowOptions onThreads = options;
    onThreads.threads = 3;
    const std::vector<std::int64_t> calls =
        cutUs > 0 ? std::vector<std::int64_t>{7'777, 31'000, 31'000, 99'999, 100'000}
                  : std::vector<std::int64_t>{8'333, 33'333, 33'333, 99'999, 100'000};
    for (const auto& other :
         {eventsOf(again, options, {100'000}), eventsOf(world, onThreads, {100'000}),
          eventsOf(again, onThreads, calls)}) {
      ASSERT_EQ(other.size(), once.size());
      for (std::size_t i = 0; i < once.size(); ++i) {
        ASSERT_TRUE(areSameBits(once[i], other[i])) << "event " << i << ", cut " << cutUs;
      }
    }
  }
}

// Every contact that begins ends once, and so does everything unresolved; and what is open is what
// has begun and not ended, at any instant to which somebody follows.
TEST(WorldFollower, EndsWhatItBegins) {
  const World world = lively(true);
  WorldFollower follower = followerFrom(0);
  std::vector<WorldEvent> open;
  const auto find = [&](const auto& one) {
    return std::find_if(open.begin(), open.end(), [&](const WorldEvent& o) {
      return o.a.body == one.a.body && o.a.link == one.a.link && o.b.body == one.b.body &&
             o.b.link == one.b.link && o.object == one.object;
    });
  };
  std::size_t most = 0;
  for (std::int64_t untilUs = 700; untilUs <= 100'000; untilUs += 700 + untilUs % 900) {
    const WorldEvents answer = followed(follower, world, untilUs);
    for (const WorldEvent& event : answer.events) {
      const auto same = find(event);
      const bool isBegin = event.kind == EventKind::Enter || event.kind == EventKind::StartsInside;
      ASSERT_EQ(same == open.end(), isBegin);
      if (isBegin) {
        open.push_back(event);
        continue;
      }
      EXPECT_TRUE(same->time == event.since);
      EXPECT_TRUE(event.since < event.time);
      open.erase(same);
    }
    ASSERT_EQ(open.size(), follower.open().size()) << untilUs;
    most = std::max(most, open.size());
    for (const OpenPart& part : follower.open()) {
      const auto begun = find(part);
      ASSERT_TRUE(begun != open.end()) << untilUs;
      EXPECT_TRUE(part.since == begun->time) << untilUs;
      EXPECT_TRUE(part.a.p_W == begun->a.p_W && part.a.lss == begun->a.lss) << untilUs;
    }
    EXPECT_EQ(std::count_if(answer.parts.begin(), answer.parts.end(),
                            [](const WorldPart& part) { return part.goesOn; }),
              static_cast<std::ptrdiff_t>(open.size()));
  }
  EXPECT_GT(most, 3u);
}

TEST(WorldFollower, RefusesWhatItCannotFollow) {
  FollowOptions options;
  options.cutUs = -1;
  EXPECT_EQ(WorldFollower::start(0, options).error().code, ErrorCode::OutOfRange);
  options.cutUs = kMostCutUs + 1;
  EXPECT_EQ(WorldFollower::start(0, options).error().code, ErrorCode::OutOfRange);
  options = {};
  options.threads = kMaxPoolThreads + 1;
  EXPECT_FALSE(WorldFollower::start(0, options).ok());
  EXPECT_EQ(WorldFollower::start(kMostUtimeUs + 1).error().code, ErrorCode::OutOfRange);

  World world = worldOf(), other = worldOf();
  for (World* const each : {&world, &other}) {
    const BodyId body = each->add(ball(0.1)).value();
    ASSERT_TRUE(each->push(body, 0, at(0.0)).ok());
    ASSERT_TRUE(each->push(body, 1'000, at(0.0)).ok());
  }
  WorldFollower follower = followerFrom(0);
  WorldEvents answer;
  const auto beyond = follower.follow(world, 2'000, answer);
  ASSERT_FALSE(beyond.ok());
  EXPECT_EQ(beyond.error().code, ErrorCode::OutOfRange);
  EXPECT_EQ(follower.followedUntilUs(), 0);
  ASSERT_TRUE(follower.follow(world, 500, answer).ok());
  EXPECT_EQ(follower.follow(other, 1'000, answer).error().code, ErrorCode::Mismatch);
  ASSERT_TRUE(follower.follow(world, 200, answer).ok());  // nothing to do
  EXPECT_EQ(answer.fromUs, 500);
  EXPECT_EQ(answer.toUs, 500);
  EXPECT_FALSE(follower.weigh(-1, massOf({Vector3d::Zero(), Vector3d::Zero(), 0.1}, 1.0)).ok());
  EXPECT_FALSE(follower.weigh(0, Mass()).ok());
  ASSERT_TRUE(follower.weigh(7, massOf({Vector3d::Zero(), Vector3d::Zero(), 0.1}, 1.0)).ok());
  const auto unknown = follower.follow(world, 1'000, answer);
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::Mismatch);
  EXPECT_EQ(unknown.error().index, 7);
}

/// Two arms that hang side by side on a trunk, each of them a rod.
Avatar twoArms() {
  RawSkeleton raw;
  raw.joints = {{"trunk", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"left", 0, Vector3d(-0.3, 0, 0), Quaternion::Identity()},
                {"right", 0, Vector3d(0.3, 0, 0), Quaternion::Identity()}};
  const Lss arm{Vector3d::Zero(), Vector3d(0, -0.6, 0), 0.04};
  return Avatar::build(Skeleton::build(raw).value(),
                       {{{Vector3d(0, 0.2, 0), Vector3d(0, 0.5, 0), 0.1}}, {arm}, {arm}})
      .value();
}

// Own links meet by the mass of one body, whose trunk gives way to both.
TEST(WorldFollower, WeighsOwnLinksThatMeet) {
  World world = worldOf();
  const Avatar avatar = twoArms();
  BodyOptions options;
  options.self = PairRules::asking(avatar, {{1, 2}}).value();
  const BodyId body = world.add(avatar, options).value();
  Pose pose = restPose(avatar.skeleton());
  ASSERT_TRUE(world.push(body, 0, pose).ok());
  const auto turned = [](double angle) {
    return Quaternion(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  };
  pose.rotations[1] = turned(0.8);
  pose.rotations[2] = turned(-0.8);
  ASSERT_TRUE(world.push(body, 100'000, pose).ok());
  WorldFollower follower = followerFrom(0);
  const std::vector<Mass> masses = massesOfLinks(avatar, 70.0).value();
  ASSERT_TRUE(follower.weigh(body, AvatarMass::build(avatar.skeleton(), masses).value()).ok());
  const WorldEvents answer = followed(follower, world, 100'000);
  ASSERT_EQ(kindsOf(answer), "enter ");
  const WorldEvent& enter = answer.events[0];
  // Where the arms are then, by hand.
  const double angle = 0.8 * microsecondsAfter(0, enter.time) / 100'000.0;
  AvatarMass mass = AvatarMass::build(avatar.skeleton(), masses).value();
  std::vector<LinkState> states(3);
  for (const int side : {1, 2}) {
    states[slotOf(side)].p_WL = Vector3d(side == 1 ? -0.3 : 0.3, 0, 0);
    states[slotOf(side)].R_WL = turned(side == 1 ? angle : -angle).toRotationMatrix();
  }
  mass.place(states);
  const Vector3d n = enter.nhat_BA_W;
  const double inverse = n.dot(mass.inverseMassBetween(1, enter.a.p_W, 2, enter.b.p_W) * n);
  EXPECT_NEAR(enter.effectiveMass, 1.0 / inverse, 1e-6 / inverse);
  EXPECT_LT(enter.effectiveMass, 35.0);
}

TEST(WorldFollower, RefusesTheMassOfAnotherAvatar) {
  World world = worldOf();
  const Avatar avatar = twoArms();
  const BodyId one = world.add(avatar).value(), rigid = world.add(ball(0.1)).value();
  ASSERT_TRUE(world.push(one, 0, restPose(avatar.skeleton())).ok());
  ASSERT_TRUE(world.push(one, 1'000, restPose(avatar.skeleton())).ok());
  for (const std::int64_t us : {0, 1'000}) ASSERT_TRUE(world.push(rigid, us, at(5.0)).ok());
  const std::vector<Mass> masses = massesOfLinks(avatar, 70.0).value();
  WorldFollower follower = followerFrom(0);
  EXPECT_FALSE(follower.weigh(-1, AvatarMass::build(avatar.skeleton(), masses).value()).ok());
  ASSERT_TRUE(follower.weigh(rigid, AvatarMass::build(avatar.skeleton(), masses).value()).ok());
  WorldEvents answer;
  const auto done = follower.follow(world, 1'000, answer);
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().code, ErrorCode::Mismatch);
  EXPECT_EQ(done.error().index, rigid);
  EXPECT_EQ(follower.followedUntilUs(), 0);
}

TEST(WorldFollower, RefusesMoreCutsThanItCouldEverFollow) {
  World world = worldOf();
  const BodyId old = world.add(ball(0.1), holdingStill()).value();
  const BodyId late = world.add(ball(0.1)).value();
  ASSERT_TRUE(world.push(old, -kMostUtimeUs, at(0.0)).ok());
  ASSERT_TRUE(world.push(late, kMostUtimeUs, at(0.0)).ok());
  FollowOptions options;
  options.cutUs = 1'000;
  WorldFollower fine = WorldFollower::start(-kMostUtimeUs, options).value();
  WorldEvents answer;
  for (const std::int64_t until : {kMostUtimeUs, -kMostUtimeUs + (kMostCuts + 2) * 1'000}) {
    const auto ages = fine.follow(world, until, answer);
    ASSERT_FALSE(ages.ok());
    EXPECT_EQ(ages.error().code, ErrorCode::OutOfRange);
    EXPECT_EQ(fine.followedUntilUs(), -kMostUtimeUs);
  }
  ASSERT_TRUE(fine.follow(world, -kMostUtimeUs + 5'000, answer).ok());  // in pieces it goes on
  WorldFollower whole = WorldFollower::start(-kMostUtimeUs).value();
  ASSERT_TRUE(whole.follow(world, kMostUtimeUs, answer).ok());  // nothing is cut
  EXPECT_EQ(answer.counters.windows, 1u);
}

TEST(WorldFollower, CutsWhereABodyAppears) {
  World world = worldOf();
  const BodyId there = world.add(ball(0.1)).value(), late = world.add(ball(0.1)).value();
  ASSERT_TRUE(world.push(there, 0, at(0.0)).ok());
  ASSERT_TRUE(world.push(there, 100'000, at(1.0)).ok());
  ASSERT_TRUE(world.push(late, 30'000, at(5.0)).ok());
  ASSERT_TRUE(world.push(late, 100'000, at(5.0)).ok());
  WorldFollower follower = followerFrom(0);
  EXPECT_EQ(followed(follower, world, 100'000).counters.windows, 2u);
}

TEST(WorldFollower, CutsAtTheEndsOfTimeToo) {
  World world = worldOf();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.push(0, 0, at(0.0)).ok());
  constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();
  FollowOptions options;
  options.cutUs = 9'999'991;  // of which neither is a multiple
  WorldEvents answer;
  WorldFollower follower = followerFrom(0, options);
  ASSERT_TRUE(follower.follow(world, kFirst, answer).ok());
  EXPECT_EQ(follower.followedUntilUs(), 0);
  const auto beyond = follower.follow(world, kLast, answer);
  EXPECT_FALSE(beyond.ok());  // too many cuts, and nobody knows so far
  EXPECT_EQ(follower.followedUntilUs(), 0);
}

TEST(WorldFollower, RefusesWorldsInWhichMeshesMeet) {
  WorldOptions meshes;
  meshes.askMeshes = true;
  World world = World::build(std::nullopt, meshes).value();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.push(0, 0, at(0.0)).ok());
  ASSERT_TRUE(world.push(0, 1'000, at(0.0)).ok());
  WorldFollower follower = followerFrom(0);
  WorldEvents answer;
  const auto refused = follower.follow(world, 1'000, answer);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::Mismatch);
  EXPECT_EQ(follower.followedUntilUs(), 0);
}

}  // namespace
}  // namespace foretouch
