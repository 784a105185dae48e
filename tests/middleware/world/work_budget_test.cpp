// What a world's budgets of work leave undecided, whom they leave their answers, and that neither
// depends on threads.
#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/worker_pool.h"
#include "middleware/world/work_shares.h"
#include "middleware/world/world.h"
#include "tests/middleware/balls.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::WorkShares;
using test::at;
using test::ball;

/// The twelve triangles of a box around the origin.
Scene box(const Vector3d& half) {
  RawScene raw;
  raw.objectNames = {"box"};
  const auto corner = [&](int i) -> Vector3d {
    return {(i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
            (i & 4) != 0 ? half.z() : -half.z()};
  };
  const int sides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& side : sides) {
    raw.triangles.push_back({{corner(side[0]), corner(side[1]), corner(side[2])}});
    raw.triangles.push_back({{corner(side[0]), corner(side[2]), corner(side[3])}});
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

Quaternion turned(double degrees, const Vector3d& axis) {
  return Quaternion(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, axis.normalized()));
}

/// A box of a metre that tumbles, and a beam so long that it sweeps kilometres while it does; what
/// is asked of them, and when they touch.
struct Beam {
  World world;
  WorldContacts answer;

  Beam(double halfLength, std::uint64_t workPerPair) : world(make(halfLength, workPerPair)) {
    Scratch scratch;
    const auto asked = world.contacts(0, 100'000, scratch, answer);
    EXPECT_TRUE(asked.ok()) << describe(asked.error());
  }
  static World make(double halfLength, std::uint64_t workPerPair) {
    WorldOptions options;
    options.askMeshes = true;
    options.workPerPair = workPerPair;
    World world = World::build(std::nullopt, options).value();
    const BodyId one = world.add(box({0.5, 0.5, 0.5})).value();
    const BodyId beam = world.add(box({1.6, halfLength, 1.9})).value();
    EXPECT_TRUE(world.push(one, 0, at(0.0)).ok());
    EXPECT_TRUE(world.push(one, 100'000, {turned(100, {1, 2, 3}), Vector3d(1.5, -1.0, 0.0)}).ok());
    EXPECT_TRUE(world.push(beam, 0, at(3.0, 0.0, 3.2)).ok());
    EXPECT_TRUE(world.push(beam, 100'000, {turned(60, {1, 0.2, 0.1}), Vector3d(0, 0, 0.5)}).ok());
    return world;
  }
  [[nodiscard]] std::uint64_t steps() const {
    const QueryCounters& c = answer.counters.queries;
    return c.partSteps + c.laneSteps + c.advancements;
  }
};

TEST(WorkBudget, LeavesUndecidedWhatCostsMoreAndIsNeverLate) {
  const Beam whole(50.0, WorldOptions().workPerPair);
  ASSERT_EQ(whole.answer.contacts.size(), 1u);
  const WorldContact& truth = whole.answer.contacts[0];
  ASSERT_EQ(truth.verdict, Verdict::Contact);
  bool isAnswered = false;
  WorldTime until{-1, 0.0};
  for (std::uint64_t work = 100; work < 100'000'000; work *= 2) {
    const Beam some(50.0, work);
    ASSERT_EQ(some.answer.contacts.size(), 1u) << work;
    const WorldContact& told = some.answer.contacts[0];
    isAnswered = told.verdict == Verdict::Contact;
    if (isAnswered) {
      EXPECT_TRUE(told.time == truth.time) << work;
      break;
    }
    EXPECT_EQ(told.verdict, Verdict::Undecided) << work;
    EXPECT_EQ(told.reason, UndecidedReason::WorkBudget) << work;
    EXPECT_EQ(told.a.link, kEveryLink);
    // No later than they touch, and more work never proves less.
    EXPECT_FALSE(truth.time < told.time) << work;
    EXPECT_FALSE(told.time < until) << work;
    until = told.time;
    // A batch beyond the budget, at most, and what readying a span takes.
    EXPECT_LE(some.steps(), work + 2000) << work;
  }
  EXPECT_TRUE(isAnswered);
}

TEST(WorkBudget, BoundsWhatAHugeMeshThatTurnsTakes) {
  const Beam huge(5e6, 200'000);
  ASSERT_EQ(huge.answer.contacts.size(), 1u);
  EXPECT_EQ(huge.answer.contacts[0].reason, UndecidedReason::WorkBudget);
  EXPECT_LE(huge.steps(), 202'000u);
}

/// Balls in a heap at the origin, and a pair that meets far away from it: the last two bodies.
World heapAndPair(int heap, std::uint64_t workPerWindow) {
  WorldOptions options;
  options.workPerWindow = workPerWindow;
  World world = World::build(std::nullopt, options).value();
  const Avatar one = ball(0.1);
  for (int i = 0; i < heap; ++i) {
    const BodyId body = world.add(one).value();
    const double x = 0.001 * i;
    EXPECT_TRUE(world.push(body, 0, at(x)).ok());
    EXPECT_TRUE(world.push(body, 10'000, at(x + 0.01)).ok());
  }
  for (const double x : {5.0, 6.0}) {
    const BodyId body = world.add(one).value();
    EXPECT_TRUE(world.push(body, 0, at(x)).ok());
    EXPECT_TRUE(world.push(body, 10'000, at(x == 5.0 ? 5.9 : 6.0)).ok());
  }
  return world;
}

// 1225 pairs that touch, and one beside them: its answer is the one that it has alone. All pairs
// that lose theirs say so.
TEST(WorkBudget, OfAHeapLeavesThoseBesideItTheirAnswers) {
  constexpr int kHeap = 50;
  const std::size_t pairs = kHeap * (kHeap - 1) / 2;
  std::vector<WorldContacts> answers;
  for (const int threads : {1, 3}) {
    const World world = heapAndPair(kHeap, 100'000);
    auto pool = WorkerPool::start(threads);
    ASSERT_TRUE(pool.ok());
    WorldContacts answer;
    ASSERT_TRUE(world.contacts(0, 10'000, pool.value(), answer).ok());
    answers.push_back(answer);
  }
  ASSERT_EQ(answers[0].contacts.size(), pairs + 1);
  std::set<std::pair<BodyId, BodyId>> told;
  std::size_t undecided = 0;
  for (const WorldContact& contact : answers[0].contacts) {
    told.insert({contact.a.body, contact.b.body});
    if (contact.a.body < kHeap) {
      const bool isSpent = contact.reason == UndecidedReason::WorkBudget;
      EXPECT_TRUE(isSpent || contact.verdict == Verdict::StartsInContact);
      undecided += isSpent ? 1 : 0;
      continue;
    }
    EXPECT_EQ(contact.a.body, kHeap);
    EXPECT_EQ(contact.verdict, Verdict::Contact);
    // 80 cm of a way of 90 cm in 10 ms.
    EXPECT_NEAR(microsecondsAfter(0, contact.time), 8'888.9, 20.0);
  }
  EXPECT_EQ(told.size(), pairs + 1);
  EXPECT_GT(undecided, pairs / 2);
  ASSERT_EQ(answers[1].contacts.size(), pairs + 1);
  for (std::size_t i = 0; i <= pairs; ++i) {
    const WorldContact &x = answers[0].contacts[i], &y = answers[1].contacts[i];
    EXPECT_TRUE(x.a.body == y.a.body && x.b.body == y.b.body && x.verdict == y.verdict &&
                x.time == y.time);
  }
}

// What the pair beside leaves over serves the heap: enough for all, though not if it were shared
// once and for all.
TEST(WorkBudget, GoesToWhoNeedsMore) {
  for (const std::uint64_t work : {std::uint64_t{20'000'000}, WorkShares::kUnlimited}) {
    const World world = heapAndPair(30, work);
    Scratch scratch;
    WorldContacts answer;
    ASSERT_TRUE(world.contacts(0, 10'000, scratch, answer).ok());
    EXPECT_EQ(answer.contacts.size(), 436u);
    for (const WorldContact& contact : answer.contacts) {
      EXPECT_NE(contact.verdict, Verdict::Undecided);
    }
  }
}

// 0 and 1 alone; 2, 3 and 4 with each other; the last pair has nothing to do.
TEST(WorkShares, AreByBodies) {
  WorkShares shares;
  shares.begin(5);
  shares.add(0, 1);
  shares.add(2, 3);
  shares.add(2, 4);
  shares.add(3, 4);
  shares.addNobody();
  shares.share(WorkShares::kUnlimited, 70);
  EXPECT_EQ(shares.of(0), 70u);
  // Weights 1, and three times a half.
  shares.share(1000, 1'000'000);
  EXPECT_EQ(shares.of(0), 400u);
  for (const std::size_t pair : {1, 2, 3}) EXPECT_EQ(shares.of(pair), 200u);
  EXPECT_EQ(shares.of(4), 0u);
  shares.share(1000, 300);
  EXPECT_EQ(shares.of(0), 300u);
  // 900 are left: 450 for each of two that had 200; 300 are not worth another try.
  std::vector<std::size_t> undone{1, 3};
  shares.shareAgain(900, 1'000'000, undone);
  EXPECT_EQ(undone, (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(shares.of(1), 450u);
  shares.shareAgain(600, 1'000'000, undone);
  EXPECT_TRUE(undone.empty());
}

TEST(WorkShares, OfLessThanTheLeastAreNotTriedAgain) {
  WorkShares shares;
  shares.begin(3);
  shares.add(0, 1);
  shares.add(0, 2);
  shares.add(1, 2);
  shares.share(1, 1'000'000);
  std::vector<std::size_t> undone{0, 1, 2};
  shares.shareAgain(1, 1'000'000, undone);
  EXPECT_TRUE(undone.empty()) << "it would be tried for ever";
}

TEST(WorkBudget, OfLessThanAUnitPerPairLeavesAllUndecided) {
  const World world = heapAndPair(50, 1'000);
  Scratch scratch;
  WorldContacts answer;
  ASSERT_TRUE(world.contacts(0, 10'000, scratch, answer).ok());
  ASSERT_EQ(answer.contacts.size(), 1226U);
  for (const WorldContact& contact : answer.contacts) {
    EXPECT_EQ(contact.reason, UndecidedReason::WorkBudget);
  }
}

}  // namespace
}  // namespace foretouch
