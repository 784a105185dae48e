// Brackets whose work is limited: whatever the budget, they never claim more than those without
// one, and with none left they claim nothing of what is open.
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/bracket/bracket.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

constexpr int kLinks = 8;

struct BudgetCase {
  Scene scene;
  test::RandomBody body;
  Pose after;
  [[nodiscard]] PosedStep step() const {
    return {&body.from, &body.from, &body.to, &after, 0.1, 0.1, 0.1};
  }
  [[nodiscard]] StepBrackets answer(std::uint64_t budget, bool isAhead) const {
    BracketOptions options;
    options.self = PairRules::derive(body.avatar).value();
    options.workBudget = budget;
    const BracketQuery query = BracketQuery::build(body.avatar, scene, options).value();
    LinkBound bound;
    bound.acceleration = bound.aheadAcceleration = 4.0;
    const std::vector<LinkBound> bounds(kLinks, bound);
    Scratch scratch;
    StepBrackets brackets;
    EXPECT_TRUE((isAhead ? query.lookAhead(step(), 0.2, bounds, scratch, brackets)
                         : query.answer(step(), MotionModel::CubicLate, bounds, scratch, brackets))
                    .ok());
    return brackets;
  }
};

BudgetCase budgetCase(int seed) {
  test::Random random(static_cast<std::uint64_t>(seed));
  Scene scene = Scene::build(test::clutter(random, 400, 3, Eigen::Vector3d::Zero())).value();
  test::RandomBody body = test::bodyInClutter(random, kLinks, Eigen::Vector3d::Zero());
  Pose after = body.to;
  for (Quaternion& rotation : after.rotations)
    rotation = (rotation * random.turn(0.2)).normalized();
  return {std::move(scene), std::move(body), std::move(after)};
}

struct BudgetTally {
  int spent = 0, opened = 0, certain = 0, excluded = 0;
};

/// What no person within the bounds can contradict in one must not be contradicted in the other.
void compare(const LinkBracket& limited, const LinkBracket& whole, BudgetTally& tally) {
  const bool isExcluded = limited.verdict == BracketVerdict::Excluded;
  const bool isCertain = limited.verdict == BracketVerdict::Certain;
  EXPECT_FALSE(isExcluded && whole.verdict == BracketVerdict::Certain);
  EXPECT_FALSE(isCertain && whole.verdict == BracketVerdict::Excluded);
  tally.excluded += isExcluded ? 1 : 0;
  tally.certain += isCertain ? 1 : 0;
  tally.opened += !isExcluded && whole.verdict == BracketVerdict::Excluded ? 1 : 0;
  if (whole.verdict != BracketVerdict::Certain || whole.certainUntil < whole.certainFrom) return;
  EXPECT_LE(limited.possibleFrom, whole.certainFrom);
  EXPECT_GE(limited.possibleUntil, whole.certainUntil);
}

TEST(BracketBudget, RunOutClaimsNothing) {
  BudgetTally tally;
  for (int seed = 0; seed < 12; ++seed) {
    const BudgetCase one = budgetCase(seed);
    for (const bool isAhead : {false, true}) {
      const StepBrackets whole = one.answer(std::numeric_limits<std::uint64_t>::max(), isAhead);
      EXPECT_FALSE(whole.isSpent);
      for (std::uint64_t budget = 1; budget < 2 * whole.work; budget *= 3) {
        const StepBrackets limited = one.answer(budget, isAhead);
        EXPECT_EQ(limited.isSpent, limited.work >= budget);
        EXPECT_LE(limited.work, whole.work);
        tally.spent += limited.isSpent ? 1 : 0;
        ASSERT_EQ(limited.links.size(), whole.links.size());
        for (std::size_t i = 0; i < whole.links.size(); ++i) {
          SCOPED_TRACE(testing::Message() << "seed " << seed << ", budget " << budget);
          compare(limited.links[i], whole.links[i], tally);
        }
        EXPECT_GE(limited.pairs.size(), whole.pairs.size());
      }
    }
  }
  EXPECT_GT(tally.spent, 50);
  EXPECT_GT(tally.opened, 50);
  EXPECT_GT(tally.certain, 25);
  EXPECT_GT(tally.excluded, 50);
}

TEST(BracketBudget, NoneIsCertainOfNothing) {
  int possible = 0;
  for (int seed = 0; seed < 12; ++seed) {
    const StepBrackets brackets = budgetCase(seed).answer(0, false);
    EXPECT_TRUE(brackets.isSpent);
    EXPECT_EQ(brackets.looks, 0U);
    for (const LinkBracket& bracket : brackets.links) {
      if (bracket.verdict == BracketVerdict::Excluded) continue;
      EXPECT_EQ(bracket.verdict, BracketVerdict::Possible);
      EXPECT_EQ(bracket.possibleFrom, 0.0);
      EXPECT_EQ(bracket.possibleUntil, 1.0);
      ++possible;
    }
  }
  EXPECT_GT(possible, 20);
}

/// The same budget, the same answer, whatever the memory was used for before.
TEST(BracketBudget, DecidesTheSameAgain) {
  const BudgetCase one = budgetCase(3);
  const StepBrackets whole = one.answer(std::numeric_limits<std::uint64_t>::max(), false);
  const StepBrackets first = one.answer(whole.work / 2, false);
  const StepBrackets again = one.answer(whole.work / 2, false);
  EXPECT_TRUE(first.isSpent);
  EXPECT_EQ(first.work, again.work);
  for (std::size_t i = 0; i < first.links.size(); ++i) {
    EXPECT_EQ(first.links[i].verdict, again.links[i].verdict);
    EXPECT_EQ(first.links[i].possibleFrom, again.links[i].possibleFrom);
  }
}

}  // namespace
}  // namespace foretouch
