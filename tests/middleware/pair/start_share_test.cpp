// Whoever begins nearer than his tolerance gets a true answer, whichever way he moves: held against
// the judge, who shares no code with the query.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "lss/simd.h"
#include "middleware/pair/leaving.h"
#include "middleware/pair/query_plan.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/support/judged.h"
#include "tests/support/judged_answer.h"
#include "tests/support/judged_pairs.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

constexpr double kShare = 0.5;

Query queryOf(const Avatar& avatar, const Scene& scene, const QueryOptions& options,
              double share = kShare) {
  auto plan = internal::QueryPlan::make(avatar, scene, options, share);
  EXPECT_TRUE(plan.ok()) << describe(plan.error());
  return Query(std::make_shared<const internal::QueryPlan>(std::move(plan).value()));
}

class StartShare : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// An upper arm and a forearm; the forearm begins at a small gap from a board and slides, leaves,
/// presses or turns. Another board stands in its way.
struct Slide {
  explicit Slide(std::uint64_t seed) : Slide(Random(seed)) {}
  explicit Slide(Random random)
      : gap(random.magnitude(1e-8, 1e-3)),
        radius(random.magnitude(1e-3, 0.05)),
        avatar(armOf(radius)),
        from(restPose(avatar.skeleton())),
        to(from) {
    const Eigen::Matrix3d R = random.rotation().toRotationMatrix();
    from.translations[0] = to.translations[0] = random.inBox(1.0);
    std::vector<LinkState> states;
    ChainMotion(avatar.skeleton(), from, from).statesAt(0.0, states);
    // The board lies below the forearm's end, across the direction in which that end is bare.
    const Lss& lss = avatar.lss(1)[0];
    const Vector3d end = states[1].pointAt(lss.b);
    const Vector3d up = (states[1].pointAt(lss.a) - end).normalized();
    const Vector3d n = (up + random.uniform(0.0, 0.9) * up.cross(R.col(0))).normalized();
    addBoard(end - (radius + gap) * n, n, random);
    addBoard(end + 0.1 * R.col(1) - 3.0 * radius * n, R.col(2), random);
    raw.objectNames = {"board", "other"};
    raw.objectOf = {0, 0, 1, 1};
    const double strength = random.magnitude(1e-5, 0.5);
    switch (random.below(4)) {
      case 0: to.translations[0] += strength * n.cross(R.col(0)); break;  // along
      case 1: to.translations[0] += strength * n; break;                  // away
      case 2: to.translations[0] -= strength * n; break;                  // towards
      default: to.rotations[1] = from.rotations[1] * random.turn(strength); break;
    }
  }

  static Avatar armOf(double radius) {
    RawSkeleton raw;
    raw.joints.push_back({"upper", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
    raw.joints.push_back({"fore", 0, Vector3d(0.3, 0.0, 0.0), Quaternion::Identity()});
    return Avatar::build(Skeleton::build(raw).value(),
                         {{}, {{Vector3d::Zero(), Vector3d(0.25, 0.05, 0.0), radius}}})
        .value();
  }

  void addBoard(const Vector3d& p, const Vector3d& n, Random& random) {
    const Vector3d u = n.cross(random.direction()).normalized(), v = n.cross(u);
    raw.triangles.push_back({{p + u, p - u + v, p - u - v}});
    raw.triangles.push_back({{p + u, p - u - v, p + u - 2.0 * v}});
  }

  [[nodiscard]] ChainMotion motion() const { return {avatar.skeleton(), from, to}; }

  double gap, radius;
  Avatar avatar;
  Pose from, to;
  RawScene raw;
};

TEST_P(StartShare, AnswersAreTrueAndWithinTheShare) {
  int passed = 0, clear = 0, later = 0, held = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(9000 + seed);
    const Slide slide(seed);
    const Scene scene = Scene::build(slide.raw).value();
    QueryOptions options;
    options.tolerance = random.magnitude(1e-5, 5e-3);
    options.scope = random.chance(0.5) ? Scope::EveryLink : Scope::FirstOfAvatar;
    if (random.chance(0.3)) options.workBudget = 1ULL << random.below(16);
    Scratch scratch;
    const LinkContact contact =
        queryOf(slide.avatar, scene, options).answer(slide.motion(), scratch).links[1];
    const oracle::Scene boards(test::plain(slide.raw.triangles));
    const oracle::Motion truth(test::plainJoints(slide.avatar.skeleton(), slide.from, slide.to));
    oracle::Judge judge(boards, truth, 1, test::plainCapsules(slide.avatar, 1));
    const auto start = static_cast<double>(judge.separationAt(0.0L));
    // Within rounding of the tolerance either is right.
    const bool isNear = start <= options.tolerance;
    const double own = internal::leavingTolerance(start, options.tolerance, kShare);
    const double tolerance = isNear && own > 0.0 ? own * (1.0 + 1e-4) : options.tolerance;
    const oracle::Judgement judgement = judge.judge(test::plain(contact), tolerance);
    EXPECT_EQ(judgement.finding, oracle::Finding::Ok)
        << oracle::toString(judgement.finding) << ' ' << judgement.what << " gap " << slide.gap
        << " eps " << options.tolerance << ' ' << toString(contact.verdict) << " at " << contact.toi
        << " separation " << contact.separation;
    if (contact.verdict == Verdict::Undecided) {
      EXPECT_EQ(contact.reason, UndecidedReason::WorkBudget);
      continue;
    }
    if (!isNear || start <= 0.0) continue;
    passed += contact.freeUntil > 0.0;
    clear += contact.verdict == Verdict::Clear;
    later += contact.verdict == Verdict::Contact && contact.toi > 0.0;
    held += contact.freeUntil == 0.0;
    if (own > 0.0) {
      EXPECT_GT(contact.freeUntil, 0.0);
    }
  }
  EXPECT_GT(passed, 150);
  EXPECT_GT(clear, 60);
  EXPECT_GT(later, 40);
  EXPECT_LT(held, 10);
}

TEST_P(StartShare, OwnPairsAreAnsweredWithinTheirShare) {
  int near = 0, clear = 0, later = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const test::OwnBody body = test::randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-3, 0.2);
    options.self = rules.value();
    Scratch scratch;
    const StepContacts plain =
        Query::build(body.avatar, test::farScene(), options).value().answer(body.motion(), scratch);
    const StepContacts step =
        queryOf(body.avatar, test::farScene(), options).answer(body.motion(), scratch);
    ASSERT_TRUE(step.arePairsAnswered);
    const test::PairsJudge judge(body.avatar, rules.value());
    const oracle::Motion truth(body.steps.precise);
    for (const test::JudgedPair& pair : judge.judge(truth, step, options.tolerance)) {
      EXPECT_TRUE(pair.isOk()) << pair.text(body.avatar.skeleton());
      const auto before =
          std::find_if(plain.pairs.begin(), plain.pairs.end(), [&](const PairContact& contact) {
            return contact.link == pair.contact.link && contact.other == pair.contact.other;
          });
      const bool beganNear =
          before != plain.pairs.end() && before->toi == 0.0 && before->verdict == Verdict::Contact;
      if (!beganNear) continue;
      ++near;
      const double own = internal::leavingTolerance(before->separation, options.tolerance, kShare);
      EXPECT_GT(pair.contact.freeUntil, 0.0);
      clear += pair.contact.verdict == Verdict::Clear;
      if (pair.contact.verdict != Verdict::Contact) continue;
      ++later;
      EXPECT_LE(pair.contact.separation, own);
    }
  }
  EXPECT_GT(near, 40);
  EXPECT_GT(clear, 10);
  EXPECT_GT(later, 10);
}

TEST(StartShares, AreRefusedByNameWhereNobodyHonoursThem) {
  const Slide slide(1);
  const Scene scene = Scene::build(slide.raw).value();
  QueryOptions options;
  for (const double share : {-0.1, 0.6, std::nan("")}) {
    const auto plan = internal::QueryPlan::make(slide.avatar, scene, options, share);
    ASSERT_FALSE(plan.ok()) << share;
    EXPECT_EQ(plan.error().file, "startShare");
  }
  options.passSeparating = true;
  EXPECT_FALSE(internal::QueryPlan::make(slide.avatar, scene, options, kShare).ok());
  options.passSeparating = false;
  options.fidelity = Fidelity::Skinned;
  Random random(1);
  const ChainMotion motion(slide.avatar.skeleton(), slide.from, slide.to);
  const test::RandomSkin made = test::randomSkin(slide.avatar, motion, random);
  options.skin = SkinnedSurface::build(slide.avatar, made.skin, made.counts).value();
  EXPECT_FALSE(internal::QueryPlan::make(slide.avatar, scene, options, kShare).ok());
  EXPECT_TRUE(internal::QueryPlan::make(slide.avatar, scene, options).ok());
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, StartShare, testing::ValuesIn(supportedSimd()),
                         [](const auto& width) { return toString(width.param); });

}  // namespace
}  // namespace foretouch
