// Random bodies whose own links meet, at every width: the independent judge proves every answer, at
// link and exact fidelity, with radii of pairs, and with every pair asked, joined ones too.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "judge/pair_prover.h"
#include "lss/index.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"
#include "tests/support/judged_pairs.h"
#include "tests/support/name_of_simd.h"

namespace foretouch {
namespace {

using test::OwnBody;
using test::Random;

struct OracleTally {
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

  Scratch scratch_;
  OracleTally tally_;
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

/// The least distance of two axes over the motion, found by samples.
double leastDistance(const OwnBody& body, LinkId a, LinkId b) {
  constexpr int kSamples = 500;
  const oracle::Motion truth(body.steps.precise);
  const auto core = [&](LinkId link) {
    const Lss& lss = body.avatar.lss(link)[0];
    return std::vector<oracle::Hull>{
        {link, 2, {test::plain(lss.a), test::plain(lss.b), test::plain(lss.b)}, 0.0}};
  };
  const oracle::PairProver axes(truth, core(a), core(b));
  oracle::Real least = oracle::Box::kEmpty;
  for (int k = 0; k <= kSamples; ++k) {
    least = std::min(least, axes.separationFrom(0, 0, static_cast<oracle::Real>(k) / kSamples));
  }
  return static_cast<double>(least);
}

/// Two links of a body, with radii such that they just meet or just miss each other, most often
/// between the instants that a query looks at.
std::optional<OwnBody> grazingBody(Random& random) {
  OwnBody body = test::randomOwnBody(random);
  const LinkId a = random.below(body.avatar.numLinks()), b = random.below(body.avatar.numLinks());
  if (a == b || body.avatar.lss(a).empty() || body.avatar.lss(b).empty()) return std::nullopt;
  const double meeting = leastDistance(body, a, b);
  const double depth = random.magnitude(1e-7, 1e-2) * (random.chance(0.5) ? 1.0 : -1.0);
  if (!(meeting + depth > 1e-3)) return std::nullopt;
  std::vector<std::vector<Lss>> lss(slotOf(body.avatar.numLinks()));
  const double share = random.uniform(0.0, 1.0);
  lss[slotOf(a)] = {body.avatar.lss(a)[0]};
  lss[slotOf(b)] = {body.avatar.lss(b)[0]};
  lss[slotOf(a)][0].radius = share * (meeting + depth);
  lss[slotOf(b)][0].radius = (1.0 - share) * (meeting + depth);
  body.avatar = Avatar::build(body.steps.skeleton, lss).value();
  return body;
}

TEST_P(SelfOracle, ProvesEveryAnswerThatGrazes) {
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const std::optional<OwnBody> body = grazingBody(random);
    if (!body) continue;
    const auto rules = PairRules::leavingOut(body->avatar, {});
    ASSERT_TRUE(rules.ok());
    QueryOptions options;
    options.tolerance = random.magnitude(1e-7, 1e-3);
    judge(*body, rules.value(), options);
  }
  EXPECT_GT(tally_.clear, 150);
  EXPECT_GT(tally_.contact, 250);
}

Quaternion about(const Eigen::Vector3d& axis, double angle) {
  const double s = std::sin(0.5 * angle);
  return {std::cos(0.5 * angle), s * axis.x(), s * axis.y(), s * axis.z()};
}

/// Two cranks on one root whose handles cross and pass each other at one instant, `depth` inside.
/// The line between their closest points never turns, and both bend towards each other as much as
/// their bounds allow: whatever takes them for straighter misses the contact.
OwnBody passingCranks(Random& random, double depth) {
  const auto lever = [&] { return random.chance(0.3) ? 0.0 : random.uniform(0.05, 0.6); };
  const double one = random.uniform(0.05, 0.6), other = lever();
  const double half = random.magnitude(0.02, 1.2) * std::max(one, other);
  const double radius = random.uniform(0.01, 0.4), radiusOfOther = random.uniform(0.01, 0.4);
  const Eigen::Vector3d apart(0, one + other + radius + radiusOfOther - depth, 0);
  const Quaternion rest = Quaternion::Identity();
  RawSkeleton raw;
  raw.joints = {{"root", kNoParent, random.inBox(2.0), rest},
                {"one", 0, Eigen::Vector3d::Zero(), rest},
                {"other", 0, apart, rest}};
  OwnBody body{{},
               Avatar::build(Skeleton::build(raw).value(),
                             {{},
                              {{{0, one, -half}, {0, one, half}, radius}},
                              {{{-half, -other, 0}, {half, -other, 0}, radiusOfOther}}})
                   .value()};
  test::RandomMotion& steps = body.steps;
  steps.skeleton = body.avatar.skeleton();
  steps.from = steps.to = restPose(steps.skeleton);
  steps.from.rotations[0] = random.rotation();
  steps.to.rotations[0] =
      steps.from.rotations[0] * random.turn(random.uniform(0.0, random.chance(0.3) ? 2.5 : 0.5));
  const double when = random.uniform(0.05, 0.95);
  const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()};
  for (std::size_t i = 0; i < 2; ++i) {
    const double way = random.uniform(0.2, random.chance(0.2) ? 3.0 : 1.2);
    steps.from.rotations[i + 1] = about(axes[i], -way * when);
    steps.to.rotations[i + 1] = about(axes[i], way * (1.0 - when));
  }
  steps.precise = test::plainJoints(steps.skeleton, steps.from, steps.to);
  return body;
}

TEST_P(SelfOracle, ProvesEveryAnswerOfCranksThatPassBetweenInstants) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const double depth = random.magnitude(1e-9, 1e-2) * (random.chance(0.7) ? 1.0 : -1.0);
    const OwnBody body = passingCranks(random, depth);
    const auto rules = PairRules::leavingOut(body.avatar, {});
    ASSERT_TRUE(rules.ok());
    QueryOptions options;
    options.tolerance = random.magnitude(1e-9, 1e-3);
    judge(body, rules.value(), options);
  }
  EXPECT_GT(tally_.contact, 1000);
  EXPECT_GT(tally_.clear, 200);
}

TEST_P(SelfOracle, ProvesEveryAnswerWhereNoPairIsLeftOut) {
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = test::randomOwnBody(random);
    const auto rules = PairRules::leavingOut(body.avatar, {});
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
    OwnBody body = test::randomOwnBody(random);
    if (random.chance(0.5)) body.avatar = test::withTwins(body.avatar, random, 0.6);
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

INSTANTIATE_TEST_SUITE_P(Widths, SelfOracle, testing::ValuesIn(supportedSimd()), test::nameOfSimd);

}  // namespace
}  // namespace foretouch
