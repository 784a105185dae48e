// What windows leave for the next ones, and what whoever follows a world is spared.
#include "middleware/world/window_query.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "middleware/world/world_parts.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::at;
using test::ball;
using test::BothWorlds;
using test::Random;

constexpr std::int64_t kMs = 1'000;

/// A triangle of many metres across x.
Scene wall(double x) {
  RawScene raw;
  raw.objectNames = {"wall"};
  raw.triangles = {{{Vector3d(x, -9, -9), Vector3d(x, 9, -9), Vector3d(x, 0, 9)}}};
  raw.objectOf = {0};
  return Scene::build(std::move(raw)).value();
}

struct Asker {
  WorldMemory scratch;
  WorldContacts answer;
  void ask(const World& world, std::int64_t fromUs, std::int64_t toUs,
           const FollowedLinks* followed = nullptr) {
    const auto done = askWindow(world, fromUs, toUs, nullptr, scratch, answer, followed);
    ASSERT_TRUE(done.ok()) << describe(done.error());
  }
};

// Of a piece of 100 ms, windows of a millisecond look at three parts, and not at a hundred.
TEST(WindowQuery, LooksAtAPartOfAPieceOnce) {
  for (const std::int64_t pieceUs : {30 * kMs, 100 * kMs}) {
    World world = World::build(wall(1.1)).value();
    const BodyId body = world.add(ball(0.1)).value();
    ASSERT_TRUE(world.push(body, 0, at(0.0)).ok());
    ASSERT_TRUE(world.push(body, pieceUs, at(1.0)).ok());
    Asker asker;
    std::set<std::pair<std::int64_t, std::int64_t>> looked;
    for (std::int64_t us = 0; us < pieceUs; us += kMs) {
      asker.ask(world, us, us + kMs);
      const SpanSweep& span = asker.scratch.sweeps[slotOf(body)].at(us);
      EXPECT_TRUE(span.isWhole);
      EXPECT_LE(span.beginUs, us);
      EXPECT_GE(span.endUs, us + kMs);
      looked.insert({span.beginUs, span.endUs});
    }
    EXPECT_EQ(looked.size(), pieceUs == 30 * kMs ? 1u : 3u);
    EXPECT_LE(asker.scratch.sweeps[slotOf(body)].spans.size(), 2u);
  }
}

// A prop is known by a box alone as long as that meets neither another one's nor the scene.
TEST(WindowQuery, LooksRoughlyAtPropsThatAreFarFromAll) {
  constexpr double kTolerance = 1e-3, kRadius = 0.1;
  const auto isRough = [](double end, double besideAtY) {
    World world = World::build(wall(1.0), {kTolerance}).value();
    const BodyId prop = world.add(ball(kRadius)).value(), other = world.add(ball(kRadius)).value();
    for (const std::int64_t us : {std::int64_t{0}, 10 * kMs}) {
      const RigidPose beside{Quaternion::Identity(), Vector3d(-0.15, besideAtY, 0.0)};
      EXPECT_TRUE(world.push(prop, us, at(us == 0 ? 0.0 : end)).ok());
      EXPECT_TRUE(world.push(other, us, beside).ok());
    }
    Asker asker;
    asker.ask(world, 0, kMs);
    EXPECT_TRUE(asker.answer.contacts.empty());
    return asker.scratch.sweeps[slotOf(prop)].isRough;
  };
  constexpr double kReach = kRadius + kTolerance;
  EXPECT_TRUE(isRough(0.9999 - kReach, 5.0));
  EXPECT_FALSE(isRough(1.0 - kReach, 5.0));
  EXPECT_FALSE(isRough(0.5, 0.15));  // their boxes meet, at a corner
}

// Pieces of up to 0.2 s, of which the judge's own world knows every window.
TEST(WindowQuery, TellsShortWindowsOfLongPieces) {
  test::WorldTally sum;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(7000 + i));
    WorldOptions options;
    options.tolerance = test::randomTolerance(random);
    BothWorlds both(test::randomMesh(random), options);
    for (int k = 0; k < 2; ++k) {
      test::Walker walker = test::randomWalker(random, random.inBox(0.3), 0.4);
      BodyOptions body;
      if (const auto rules = PairRules::derive(walker.avatar); rules.ok()) {
        body.self = rules.value();
      }
      const std::int64_t periodUs = 45 * kMs + random.below(150'000);
      test::walk(both, both.add(walker.avatar, body), walker, periodUs, test::kWindowUs, random);
    }
    for (std::int64_t begin = random.below(20'000); begin < test::kWindowUs;) {
      const int longest = random.chance(0.7) ? 3'000 : 12'000;
      const std::int64_t end = std::min(test::kWindowUs, begin + 300 + random.below(longest));
      both.judgeAll(begin, end);
      begin = end;
    }
    test::add(both, sum);
  }
  EXPECT_GT(sum.clear, 3000);
  EXPECT_GT(sum.contact, 50);
  EXPECT_GT(sum.start, 300);
  EXPECT_EQ(sum.undecided, 0);
}

// So far away, doubles do not tell where the middle of a motion is: no window claims anything.
TEST(WindowQuery, GivesUpInEachWindowWhatDoublesDoNotTell) {
  constexpr double kFar = 9e6;
  World world = World::build(wall(kFar + 0.5), {1e-8}).value();
  const BodyId body = world.add(ball(0.1)).value();
  ASSERT_TRUE(world.push(body, 0, at(kFar)).ok());
  ASSERT_TRUE(world.push(body, 100 * kMs, at(kFar + 1.0)).ok());
  Asker asker;
  for (std::int64_t us = 0; us < 40 * kMs; us += kMs) {
    asker.ask(world, us, us + kMs);
    ASSERT_EQ(asker.answer.contacts.size(), 1u) << us;
    const WorldContact& open = asker.answer.contacts[0];
    EXPECT_EQ(open.verdict, Verdict::Undecided);
    EXPECT_EQ(open.reason, UndecidedReason::Resolution);
    EXPECT_EQ(open.a.link, kEveryLink);
    EXPECT_TRUE(open.time == (WorldTime{us, 0.0})) << us;
  }
}

/// Two balls that meet at 5 ms of a motion, and a wall that one of them meets there as well.
World meeting() {
  World world = World::build(wall(0.6)).value();
  for (const double x : {0.0, 0.7}) {
    const BodyId body = world.add(ball(0.1)).value();
    EXPECT_TRUE(world.push(body, 0, at(x)).ok());
    EXPECT_TRUE(world.push(body, 10 * kMs, at(x == 0.0 ? 1.0 : x)).ok());
  }
  return world;
}

// Who met the wall before the window may meet it from its begin on; nobody is asked whether.
TEST(WindowQuery, TellsWhoFollowsWhoHasMetWithoutAskingAgain) {
  const World world = meeting();
  Asker asker, follower;
  const FollowedLinks nobody;
  for (const std::int64_t us : {4 * kMs, 8 * kMs}) {
    asker.ask(world, us, us + 2 * kMs);
    follower.ask(world, us, us + 2 * kMs, &nobody);
    const auto ofWall = [](const WorldContacts& answer) {
      return std::find_if(answer.contacts.begin(), answer.contacts.end(), [](const auto& contact) {
        return contact.a.body == 0 && contact.b.body == kStillScene;
      });
    };
    const auto told = ofWall(follower.answer), asked = ofWall(asker.answer);
    ASSERT_NE(told, follower.answer.contacts.end()) << us;
    if (us == 4 * kMs) {  // it meets the wall in this one
      ASSERT_NE(asked, asker.answer.contacts.end());
      EXPECT_TRUE(told->time == asked->time);
    } else {  // and has left it
      EXPECT_EQ(asked, asker.answer.contacts.end());
      EXPECT_TRUE(told->time == (WorldTime{us, 0.0}));
    }
  }
  EXPECT_LT(follower.answer.counters.spans, asker.answer.counters.spans);
}

// Whom he knows he is not told, unless somebody carries one of them or appears in the window.
TEST(WindowQuery, LeavesOutWhomTheFollowerKnows) {
  World world = meeting();
  const auto isTold = [&](std::int64_t fromUs, std::int64_t toUs, const FollowedLinks* followed) {
    Asker asker;
    asker.ask(world, fromUs, toUs, followed);
    return std::any_of(
        asker.answer.contacts.begin(), asker.answer.contacts.end(),
        [](const auto& contact) { return contact.a.body == 0 && contact.b.body == 1; });
  };
  FollowedLinks both, fromTheFirst, others;
  both.pairs = {{0, 1, 0, 0, kMs}};
  fromTheFirst.pairs = {{0, 1, 0, 0, 0}};  // where the two appear: it may have been told since
  others.pairs = {{0, 1, 0, 1}, {0, 2, 0, 0}, {1, 2, 0, 0}};
  EXPECT_TRUE(isTold(4 * kMs, 6 * kMs, nullptr));
  EXPECT_TRUE(isTold(4 * kMs, 6 * kMs, &others));
  EXPECT_TRUE(isTold(4 * kMs, 6 * kMs, &fromTheFirst));
  EXPECT_FALSE(isTold(4 * kMs, 6 * kMs, &both));
  const BodyId hand = world.add(ball(0.1)).value();
  ASSERT_TRUE(world.push(hand, 0, at(9.0)).ok());
  ASSERT_TRUE(world.push(hand, 10 * kMs, at(9.0)).ok());
  ASSERT_TRUE(world.attach(1, {hand, 0}, 5 * kMs, at(0.7 - 9.0)).ok());
  EXPECT_TRUE(isTold(4 * kMs, 6 * kMs, &both));
  EXPECT_TRUE(isTold(6 * kMs, 8 * kMs, &both));
}

}  // namespace
}  // namespace foretouch::internal
