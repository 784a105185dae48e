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

TEST(LinearLeaf, IsDrawnTheSameAnywhere) {
  for (std::size_t f = 0; f < linearFamilies().size(); ++f) {
    EXPECT_EQ(inHex(drawLinear(f, 1, 5)), inHex(drawLinear(f, 1, 5)));
    EXPECT_NE(inHex(drawLinear(f, 1, 5)), inHex(drawLinear(f, 2, 5)));
  }
}

}  // namespace
}  // namespace foretouch::test
