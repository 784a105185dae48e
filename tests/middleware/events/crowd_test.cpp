// Who is crowded is told once as a body of which nothing is known, for as long as it is; whoever is
// beside the crowd, and whoever among it meets somebody who is not, is told as without it. And of a
// call that has too many poses in it, the last window takes what is left.
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/events/world_follower.h"
#include "middleware/scratch.h"
#include "middleware/world/world.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

constexpr int kHeap = 30;
constexpr std::int64_t kEndUs = 90'000;

RigidPose placeAt(const Vector3d& place) {
  return {Quaternion::Identity(), place};
}

/// From ball to ball of the heap.
double spreadAt(std::int64_t us) {
  if (us <= 30'000) return 0.001;
  return us >= 60'000 ? 1.0 : 0.001 + 3.33e-5 * static_cast<double>(us - 30'000);
}

Avatar crowdBall() {
  RawSkeleton raw;
  raw.joints = {{"ball", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Lss lss{Vector3d::Zero(), Vector3d::Zero(), 0.1};
  return Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
}

/// Balls that lie in one another until 30 ms, and are apart from 60 ms on; then a pair of which one
/// flies through the other; then one that flies through the heap's place after it has dissolved.
World crowdedWorld(std::size_t mostNear) {
  WorldOptions options;
  options.mostNear = mostNear;
  World world = World::build(std::nullopt, options).value();
  const Avatar ball = crowdBall();
  for (int i = 0; i < kHeap; ++i) {
    const BodyId body = world.add(ball).value();
    for (std::int64_t us = 0; us <= kEndUs; us += 10'000) {
      const double spread = spreadAt(us);
      EXPECT_TRUE(
          world.push(body, us, placeAt({spread * i, 1e-7 * static_cast<double>(us), 0.0})).ok());
    }
  }
  const BodyId still = world.add(ball).value(), flying = world.add(ball).value();
  for (std::int64_t us = 0; us <= kEndUs; us += 10'000) {
    EXPECT_TRUE(world.push(still, us, placeAt({0.0, 50.0, 0.0})).ok());
    const double x = 1e-5 * static_cast<double>(us - 45'000);
    EXPECT_TRUE(world.push(flying, us, placeAt({x, 50.0, 0.0})).ok());
  }
  return world;
}

WorldEvents follow(const World& world, const FollowOptions& options = {}) {
  WorldFollower follower = WorldFollower::start(0, options).value();
  WorldEvents events;
  EXPECT_TRUE(follower.follow(world, kEndUs, events).ok());
  return events;
}

/// Of the pair beside the crowd.
std::vector<WorldEvent> besideOf(const WorldEvents& events) {
  std::vector<WorldEvent> beside;
  for (const WorldEvent& event : events.events) {
    if (event.a.body == kHeap) beside.push_back(event);
  }
  return beside;
}

TEST(Crowds, AreToldOnceWhileOthersAreAnswered) {
  const std::vector<WorldEvent> truth = besideOf(follow(crowdedWorld(1'000)));
  ASSERT_EQ(truth.size(), 2U);
  for (const int threads : {1, 3}) {
    FollowOptions options;
    options.threads = threads;
    const WorldEvents events = follow(crowdedWorld(8), options);
    std::map<BodyId, int> from, to;
    for (const WorldEvent& event : events.events) {
      if (event.b.body != kEveryBody) continue;
      EXPECT_EQ(event.reason, UndecidedReason::WorkBudget);
      ++(event.kind == EventKind::UnresolvedFrom ? from : to)[event.a.body];
    }
    EXPECT_EQ(from.size(), static_cast<std::size_t>(kHeap));
    EXPECT_EQ(to, from) << "they are apart in the end";
    for (const auto& [body, times] : from) EXPECT_EQ(times, 1) << body;
    const std::vector<WorldEvent> beside = besideOf(events);
    ASSERT_EQ(beside.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      EXPECT_EQ(beside[i].kind, truth[i].kind);
      EXPECT_TRUE(beside[i].time == truth[i].time);
    }
    // A crowd of thirty has 435 pairs.
    EXPECT_LT(events.events.size(), 250U);
  }
}

// By plain arithmetic: of two balls of the heap nothing is claimed while they touch and are
// crowded, and what is claimed is true.
TEST(Crowds, NothingFalseIsClaimedOfThem) {
  const WorldEvents events = follow(crowdedWorld(8));
  const auto isIn = [](const WorldPart& part, std::int64_t us) {
    const WorldTime time{us, 0.0};
    return !(time < part.from) && !(part.to < time);
  };
  int judged = 0;
  for (std::int64_t us = 1'000; us < kEndUs; us += 7'000) {
    const double spread = spreadAt(us);
    if (us > 58'000 && us < 62'000) continue;  // between two of these
    for (BodyId a = 0; a < kHeap; ++a) {
      for (BodyId b = a + 1; b < kHeap; ++b) {
        const bool touches = spread * (b - a) <= 0.2;
        bool isContact = false, isUnknown = false;
        for (const WorldPart& part : events.parts) {
          if (!isIn(part, us)) continue;
          const bool isOfBoth = part.a.body == a && part.b.body == b;
          const bool isOfOne = part.b.body == kEveryBody && (part.a.body == a || part.a.body == b);
          isContact = isContact || (isOfBoth && part.kind == PartKind::Contact);
          isUnknown = isUnknown || ((isOfBoth || isOfOne) && part.kind == PartKind::Unresolved);
        }
        ASSERT_TRUE(!touches || isContact || isUnknown) << a << ", " << b << " at " << us;
        const bool isFar = spread * (b - a) > 0.2 + 3e-3;
        ASSERT_FALSE(isFar && isContact) << a << ", " << b << " at " << us;
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 4'000);
}

// Their silence does not hide that they were not asked about each other.
TEST(Crowds, WhoHoldsStillInOneIsCrowdedAllTheSame) {
  WorldOptions options;
  options.mostNear = 8;
  World world = World::build(std::nullopt, options).value();
  const Avatar ball = crowdBall();
  BodyOptions held;
  held.whenSilent = WhenSilent::HoldStill;
  for (int i = 0; i < kHeap; ++i) {
    const BodyId body = world.add(ball, held).value();
    ASSERT_TRUE(world.push(body, 0, placeAt({0.001 * i, 0.0, 0.0})).ok());
  }
  const BodyId known = world.add(ball).value();
  for (const std::int64_t us : {0, 20'000}) {
    ASSERT_TRUE(world.push(known, us, placeAt({0.0, 50.0, 0.0})).ok());
  }
  Scratch scratch;
  WorldContacts answer;
  const auto done = world.contacts(10'000, 20'000, scratch, answer);
  ASSERT_TRUE(done.ok()) << describe(done.error());
  ASSERT_EQ(answer.silent.size(), static_cast<std::size_t>(kHeap));
  for (const SilentBody& silent : answer.silent) {
    EXPECT_EQ(silent.takenTo, WhenSilent::Undecided) << silent.body;
    EXPECT_EQ(silent.reason, UndecidedReason::WorkBudget) << silent.body;
  }
}

TEST(Crowds, ACallHasOnlySoManyWindows) {
  const World world = crowdedWorld(1'000);
  const WorldEvents all = follow(world);
  FollowOptions options;
  options.mostWindows = 3;
  const WorldEvents few = follow(world, options);
  EXPECT_GT(all.counters.windows, 3U);
  EXPECT_EQ(few.counters.windows, 3U);
  const std::vector<WorldEvent> one = besideOf(all), other = besideOf(few);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].kind, other[i].kind);
    EXPECT_NEAR(microsecondsAfter(0, one[i].time), microsecondsAfter(0, other[i].time), 100.0);
  }
}

}  // namespace
}  // namespace foretouch
