// Random bodies whose own links meet, at every width: the independent judge proves every answer, at
// link and exact fidelity, with radii of pairs, and with every pair asked, joined ones too.
#include <optional>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"
#include "tests/support/judged_pairs.h"

namespace foretouch {
namespace {

using test::OwnBody;
using test::Random;

struct Tally {
  int clear = 0, contact = 0, start = 0, undecided = 0;

  void add(oracle::Verdict verdict) {
    switch (verdict) {
      case oracle::Verdict::Clear: ++clear; break;
      case oracle::Verdict::Contact: ++contact; break;
      case oracle::Verdict::StartsInContact: ++start; break;
      case oracle::Verdict::Undecided: ++undecided; break;
    }
  }
};

class SelfOracle : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }

  /// Every asked pair of the body, judged.
  void judge(const OwnBody& body, const PairRules& rules, QueryOptions options) {
    options.self = rules;
    if (options.surface) options.fidelity = Fidelity::Exact;
    const StepContacts step =
        test::answerOf(body.avatar, body.motion(), test::farScene(), options, scratch_);
    ASSERT_TRUE(step.arePairsAnswered);
    const test::PairsJudge judge(body.avatar, rules, options.surface ? &*options.surface : nullptr);
    const oracle::Motion truth(body.steps.precise);
    for (const test::JudgedPair& pair : judge.judge(truth, step, options.tolerance)) {
      EXPECT_TRUE(pair.isOk()) << "eps " << options.tolerance << ", "
                               << pair.text(body.avatar.skeleton());
      tally_.add(pair.verdict);
    }
  }

  QueryScratch scratch_;
  Tally tally_;
};

TEST_P(SelfOracle, ProvesEveryAnswerOfRandomBodies) {
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = test::randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-7, 1e-2);
    judge(body, rules.value(), options);
  }
  EXPECT_GT(tally_.clear, 1500);
  EXPECT_GT(tally_.contact, 150);
  EXPECT_GT(tally_.start, 150);
  EXPECT_EQ(tally_.undecided, 0);
}

TEST_P(SelfOracle, ProvesEveryAnswerWhereNoPairIsLeftOut) {
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = test::randomOwnBody(random);
    const auto rules = PairRules::of(body.avatar, {});
    ASSERT_TRUE(rules.ok());
    QueryOptions options;
    options.tolerance = random.magnitude(1e-7, 1e-2);
    judge(body, rules.value(), options);
  }
  EXPECT_GT(tally_.contact, 100);
  EXPECT_GT(tally_.start, 300);
}

TEST_P(SelfOracle, ProvesEveryAnswerWithRadiiOfPairs) {
  int withRadii = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = test::randomOwnBody(random);
    PairRuleOptions own;
    own.usePairRadii = true;
    const auto rules = PairRules::derive(body.avatar, own);
    if (!rules.ok()) continue;
    withRadii += rules.value().radii().empty() ? 0 : 1;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 1e-2);
    judge(body, rules.value(), options);
  }
  EXPECT_GT(withRadii, 50);
  EXPECT_GT(tally_.contact, 100);
}

TEST_P(SelfOracle, ProvesEveryExactAnswer) {
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = test::randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    auto meshes = test::meshWithin(body.avatar, random, 1 + random.below(12), 0.9);
    // Some links without a mesh meet by their LSS.
    for (auto& mesh : meshes) {
      if (random.chance(0.15)) mesh.clear();
    }
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 1e-2);
    options.surface = AvatarSurface::build(body.avatar, std::move(meshes)).value();
    judge(body, rules.value(), options);
  }
  EXPECT_GT(tally_.clear, 500);
  EXPECT_GT(tally_.contact, 50);
  EXPECT_GT(tally_.start, 5);
}

std::string nameOf(const testing::TestParamInfo<Simd>& tested) {
  return toString(tested.param);
}
INSTANTIATE_TEST_SUITE_P(Widths, SelfOracle, testing::ValuesIn(supportedSimd()), nameOf);

}  // namespace
}  // namespace foretouch
