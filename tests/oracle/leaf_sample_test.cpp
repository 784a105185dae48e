// tests/oracle/leaf_sample_test.cpp: a sample of the leaf campaign. The seeds are fixed: what fails
// here is printed with its seed and index, and as hexadecimal doubles.
#include <gtest/gtest.h>

#include "tests/oracle/leaf_campaign.h"
#include "tests/oracle/pair_campaign.h"
#include "tests/oracle/rigid_campaign.h"

namespace foretouch::test {
namespace {

constexpr std::uint64_t kSeed = 2026;

template <typename Families>
void expectAllRight(const Families& families, const std::vector<LeafTally>& tallies) {
  std::cout << "seed " << kSeed << "\n";
  for (std::size_t i = 0; i < families.size(); ++i) {
    SCOPED_TRACE(families[i].name);
    const LeafTally& t = tallies[i];
    EXPECT_EQ(t.falseNegatives, 0u) << tableOf({families[i].name}, {t});
    EXPECT_EQ(t.falsePositives, 0u) << tableOf({families[i].name}, {t});
    EXPECT_EQ(t.wrongTimes, 0u) << tableOf({families[i].name}, {t});
    EXPECT_EQ(t.thrown, 0u) << tableOf({families[i].name}, {t});
    EXPECT_EQ(t.unproved, 0u) << tableOf({families[i].name}, {t});
    EXPECT_GT(t.hitShare(), families[i].leastHits);
    EXPECT_LT(t.hitShare(), families[i].mostHits);
  }
}

TEST(LinearLeaf, AnswersASampleOfEveryFamilyRight) {
  expectAllRight(linearFamilies(), judgeLinear(LeafJob{kSeed, 2'200, 2}));
}

TEST(RigidLeaf, AnswersASampleOfEveryFamilyRight) {
  expectAllRight(rigidFamilies(), judgeRigid(LeafJob{kSeed, 300, 2}));
}

TEST(TrianglePair, AnswersASampleOfEveryFamilyRight) {
  std::vector<LinearFamily> families;
  for (const std::string& name : pairFamilies()) families.push_back({name, nullptr, 0.1, 0.97});
  expectAllRight(families, judgePairs(LeafJob{kSeed, 500, 2}));
}

// Controls: answers that are wrong by little, or blindly, are each named for what they are.
TEST(JudgeAnswer, NamesPlantedLies) {
  constexpr std::uint64_t kEach = 200;
  for (std::size_t f = 0; f < linearFamilies().size(); ++f) {
    SCOPED_TRACE(linearFamilies()[f].name);
    LeafTally always, never, right, late, early;
    std::uint64_t hits = 0, misses = 0, movable = 0;
    for (std::uint64_t i = 0; i < kEach; ++i) {
      const oracle::LinearQuery query = drawLinear(f, kSeed, i);
      const oracle::LinearTruth truth = oracle::linearTruthByRationals(query);
      LeafAnswer hit;
      hit.hits = true;
      hit.toiLow = truth.low;
      hit.toiHigh = truth.high;
      judgeAnswer(query, hit, "always", always);
      judgeAnswer(query, LeafAnswer{}, "never", never);
      (truth.hits ? hits : misses) += 1;
      if (!truth.hits) continue;
      judgeAnswer(query, hit, "right", right);
      if (!(truth.low > 1e-6 && truth.high < 1 - 1e-6)) continue;
      ++movable;
      const double off = truth.high - truth.low + 1e-15;
      LeafAnswer wrong = hit;
      wrong.toiLow += off;
      wrong.toiHigh += off;
      judgeAnswer(query, wrong, "late", late);
      wrong.toiLow = hit.toiLow - 2 * off;
      wrong.toiHigh = hit.toiHigh - 2 * off;
      judgeAnswer(query, wrong, "early", early);
    }
    EXPECT_EQ(always.falsePositives, misses);
    EXPECT_EQ(never.falseNegatives, hits);
    EXPECT_EQ(right.wrong(), 0u);
    EXPECT_EQ(late.wrongTimes, movable);
    EXPECT_EQ(early.wrongTimes, movable);
    EXPECT_GT(misses, 10u);
    EXPECT_GT(movable, 5u);
  }
}

TEST(JudgeAnswer, RefusesIntervalsThatAreNone) {
  LeafTally tally;
  LeafAnswer wide;
  wide.hits = true;
  wide.toiLow = 0.0;  // holds every first contact, and says nothing
  for (std::uint64_t i = 0; i < 50; ++i) judgeAnswer(drawLinear(0, kSeed, i), wide, "", tally);
  EXPECT_EQ(tally.wrong(), 50u);
  EXPECT_GT(tally.wrongTimes, 10u);
}

TEST(LinearLeaf, IsDrawnTheSameAnywhere) {
  for (std::size_t f = 0; f < linearFamilies().size(); ++f) {
    EXPECT_EQ(inHex(drawLinear(f, 1, 5)), inHex(drawLinear(f, 1, 5)));
    EXPECT_NE(inHex(drawLinear(f, 1, 5)), inHex(drawLinear(f, 2, 5)));
  }
}

}  // namespace
}  // namespace foretouch::test
