// The promise of firstContacts() against closed forms: sound (never late) and tight (within
// tolerance).
#include <cmath>
#include <ostream>

#include <gtest/gtest.h>

#include "middleware/query/query.h"
#include "tests/middleware/analytic_cases.h"
#include "tests/reference/reference_query.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::AnalyticCase;
using test::Random;

struct Family {
  const char* name;
  test::CaseMaker make;
  double leastHits, mostHits;  // share of cases in which the link is touched
};

/// The case's name, for test listings.
void PrintTo(const Family& tested, std::ostream* out) {
  *out << tested.name;
}

class FirstContacts : public testing::TestWithParam<Family> {};

/// The verdict, with everything that the closed form can say of it.
void judge(const AnalyticCase& c, const LinkContact& got, double tolerance) {
  switch (got.verdict) {
    case Verdict::Clear:
      EXPECT_FALSE(c.impact.has_value()) << "missed";
      EXPECT_EQ(got.freeUntil, 1.0);
      break;
    case Verdict::Contact:
      if (c.impact) {
        EXPECT_LE(got.toi, *c.impact + c.guard) << "late";
      }
      EXPECT_FALSE(c.startsInContact);
      EXPECT_GE(c.separationAt(got.toi), -c.guard) << "late";
      EXPECT_LE(c.separationAt(got.toi), tolerance + c.guard) << "early";
      EXPECT_NEAR(got.separation, c.separationAt(got.toi), 1e-9 + c.guard);
      EXPECT_NEAR(got.nhat_SL_W.norm(), 1.0, 1e-12);
      EXPECT_NEAR((got.p_WLink - got.p_WScene).dot(got.nhat_SL_W), got.separation, 1e-9 + c.guard);
      break;
    case Verdict::StartsInContact:
      EXPECT_TRUE(c.startsInContact || c.separationAt(0.0) <= c.guard);
      EXPECT_EQ(got.toi, 0.0);
      EXPECT_NEAR(got.penetration, std::min(c.lss.radius, -c.separationAt(0.0)), 1e-9 + c.guard);
      break;
    case Verdict::Undecided: ADD_FAILURE() << "undecided: " << toString(got.reason); break;
  }
}

TEST_P(FirstContacts, AreSoundAndTight) {
  constexpr int kCases = 3000;
  const double tolerances[] = {1e-2, 1e-3, 1e-5, 1e-7};
  int hits = 0;
  Scratch scratch;
  for (int i = 0; i < kCases; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    AnalyticCase c = GetParam().make(random);
    c.place(random);
    SCOPED_TRACE(c.name + " " + std::to_string(i));
    QueryOptions options;
    options.tolerance = tolerances[random.below(4)];
    const auto step = test::answerOf(c.avatar(), c.motion(), c.scene(), options, scratch);
    judge(c, step.links[AnalyticCase::kLink], options.tolerance);
    EXPECT_EQ(step.links[0].verdict, Verdict::Clear) << "a link without LSS touches nothing";
    hits += c.impact.has_value() ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GE(hits, GetParam().leastHits * kCases);
  EXPECT_LE(hits, GetParam().mostHits * kCases);
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, FirstContacts,
                         testing::Values(Family{"FallingSphere", test::fallingSphere, 0.3, 0.7},
                                         Family{"RodToFloor", test::rodToFloor, 0.3, 0.8},
                                         Family{"RodToEdge", test::rodToEdge, 0.3, 0.8},
                                         Family{"RodToVertex", test::rodToVertex, 0.3, 0.8},
                                         Family{"ParallelRod", test::parallelRod, 0.3, 0.7},
                                         Family{"PassingSphere", test::passingSphere, 0.3, 0.7},
                                         Family{"StandingStill", test::standingStill, 0.2, 0.5},
                                         Family{"HalfTurn", test::halfTurn, 1.0, 1.0}),
                         [](const auto& tested) { return std::string(tested.param.name); });

// A discrete check sees neither end of the swing: the control that shows what CCD is for.
TEST(TouchesAt, BothPosesAreFreeWhileTheSwingIsNot) {
  Random random(1);
  AnalyticCase c = test::halfTurn(random);
  Scratch scratch;
  const Avatar avatar = c.avatar();
  const ChainMotion motion = c.motion();
  const Scene scene = c.scene();
  EXPECT_FALSE(test::touchesAt(avatar, motion, AnalyticCase::kLink, 0.0, scene, {}, scratch));
  EXPECT_FALSE(test::touchesAt(avatar, motion, AnalyticCase::kLink, 1.0, scene, {}, scratch));
  const auto result = firstContacts(avatar, motion, scene);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().links[AnalyticCase::kLink].verdict, Verdict::Contact);
}

TEST(TouchesAt, SeesWhatIsTouchedAtThatInstant) {
  Random random(5);
  AnalyticCase c = test::fallingSphere(random);
  while (!c.impact || c.lss.radius < 1e-3) c = test::fallingSphere(random);
  Scratch scratch;
  EXPECT_FALSE(test::touchesAt(c.avatar(), c.motion(), AnalyticCase::kLink, *c.impact - 1e-4,
                               c.scene(), {}, scratch));
  EXPECT_TRUE(test::touchesAt(c.avatar(), c.motion(), AnalyticCase::kLink, *c.impact + 1e-4,
                              c.scene(), {}, scratch));
  QueryOptions ignoring;
  ignoring.ignored = {{AnalyticCase::kLink, 0}};
  EXPECT_FALSE(test::touchesAt(c.avatar(), c.motion(), AnalyticCase::kLink, *c.impact + 1e-4,
                               c.scene(), ignoring, scratch));
}

AnalyticCase certainHit() {
  Random random(0);
  return test::halfTurn(random);
}

TEST(FirstContactsOptions, RefusesTolerancesThatMeanNothing) {
  const AnalyticCase c = certainHit();
  for (const double tolerance : {0.0, -1.0, 1e-10, std::nan(""), HUGE_VAL, 1.1e7, 1e39, 1e300}) {
    QueryOptions options;
    options.tolerance = tolerance;
    const auto result = firstContacts(c.avatar(), c.motion(), c.scene(), options);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::OutOfRange);
  }
}

// With boxes of floats that have no end, the empty children of a node would be met.
TEST(FirstContactsOptions, TakesTheLargestTolerance) {
  const AnalyticCase c = certainHit();
  for (const Backtracking backtracking : {Backtracking::Lanes, Backtracking::Scalar}) {
    for (const Culler culler : {Culler::FlatBvh, Culler::PointQuery}) {
      QueryOptions options;
      options.tolerance = kMaxTolerance;
      ReferenceOptions reference;
      reference.backtracking = backtracking;
      reference.culler = culler;
      const auto result = firstContacts(c.avatar(), c.motion(), c.scene(), options, reference);
      ASSERT_TRUE(result.ok());
      const LinkContact& contact = result.value().links[AnalyticCase::kLink];
      EXPECT_EQ(contact.freeUntil, 0.0);
      EXPECT_NE(contact.verdict, Verdict::Clear);
    }
  }
}

TEST(FirstContactsOptions, RefusesPairsThatDoNotExist) {
  const AnalyticCase c = certainHit();
  for (const IgnoredPair pair : {IgnoredPair{2, 0}, IgnoredPair{-1, 0}, IgnoredPair{0, 1}}) {
    QueryOptions options;
    options.ignored = {pair};
    EXPECT_FALSE(firstContacts(c.avatar(), c.motion(), c.scene(), options).ok());
  }
}

TEST(FirstContactsOptions, RefusesTheMotionOfAnotherAvatar) {
  const AnalyticCase c = certainHit();
  RawSkeleton raw;
  raw.joints.push_back({"alone", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  const Skeleton other = Skeleton::build(raw).value();
  const ChainMotion motion(other, restPose(other), restPose(other));
  const auto result = firstContacts(c.avatar(), motion, c.scene());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::Mismatch);
}

TEST(FirstContactsOptions, IgnoredPairsAreNotReported) {
  const AnalyticCase c = certainHit();
  QueryOptions options;
  options.ignored = {{AnalyticCase::kLink, 0}};
  auto result = firstContacts(c.avatar(), c.motion(), c.scene(), options);
  EXPECT_EQ(result.value().links[AnalyticCase::kLink].verdict, Verdict::Clear);
  options.ignored = {{AnalyticCase::kLink, IgnoredPair::kEveryObject}};
  result = firstContacts(c.avatar(), c.motion(), c.scene(), options);
  EXPECT_EQ(result.value().links[AnalyticCase::kLink].verdict, Verdict::Clear);
  options.ignored = {{0, 0}};
  result = firstContacts(c.avatar(), c.motion(), c.scene(), options);
  EXPECT_EQ(result.value().links[AnalyticCase::kLink].verdict, Verdict::Contact);
}

struct BudgetCounts {
  int undecided = 0, decided = 0, partly = 0;
};

/// A spent budget is never a miss: whatever it is, the motion is free up to what is claimed.
BudgetCounts judgeBudgets(Backtracking backtracking) {
  constexpr std::uint64_t kBudgetStep = 40, kBudgets = 30;
  BudgetCounts counts;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    AnalyticCase c = test::rodToEdge(random);
    c.place(random);
    double before = 0.0;
    for (std::uint64_t budget = 0; budget < kBudgets; ++budget) {
      QueryOptions options;
      ReferenceOptions reference;
      reference.backtracking = backtracking;
      options.tolerance = 1e-5;
      options.workBudget = budget * kBudgetStep;
      const StepContacts step =
          firstContacts(c.avatar(), c.motion(), c.scene(), options, reference).value();
      const LinkContact& got = step.links[AnalyticCase::kLink];
      if (got.verdict != Verdict::Undecided) {
        judge(c, got, options.tolerance);
        ++counts.decided;
        continue;
      }
      ++counts.undecided;
      counts.partly += got.freeUntil > 0.0 ? 1 : 0;
      EXPECT_EQ(got.reason, UndecidedReason::WorkBudget);
      EXPECT_LE(got.freeUntil, c.impact.value_or(1.0));
      EXPECT_GE(got.freeUntil, before) << "more work must not claim less";
      before = got.freeUntil;
    }
  }
  return counts;
}

TEST(FirstContactsBudget, EveryBudgetIsSoundInDoubles) {
  const BudgetCounts counts = judgeBudgets(Backtracking::Scalar);
  EXPECT_GT(counts.undecided, 1000);
  EXPECT_GT(counts.partly, 300);
  EXPECT_GT(counts.decided, 1000);
}

TEST(FirstContactsBudget, EveryBudgetIsSoundInLanes) {
  const BudgetCounts counts = judgeBudgets(Backtracking::Lanes);
  EXPECT_GT(counts.undecided, 500);
  EXPECT_GT(counts.partly, 100);
  EXPECT_GT(counts.decided, 1000);
}

TEST(FirstContactsBudget, APassedDeadlineLeavesEverythingUndecided) {
  const AnalyticCase c = certainHit();
  QueryOptions options;
  options.deadlineUs = 0.0;
  for (const Backtracking backtracking : {Backtracking::Scalar, Backtracking::Lanes}) {
    ReferenceOptions reference;
    reference.backtracking = backtracking;
    const StepContacts step =
        firstContacts(c.avatar(), c.motion(), c.scene(), options, reference).value();
    const LinkContact& got = step.links[AnalyticCase::kLink];
    EXPECT_EQ(got.verdict, Verdict::Undecided);
    EXPECT_EQ(got.reason, UndecidedReason::WorkBudget);
    EXPECT_LE(got.freeUntil, *c.impact);
  }
  options.deadlineUs = 1e9;
  EXPECT_EQ(firstContacts(c.avatar(), c.motion(), c.scene(), options)
                .value()
                .links[AnalyticCase::kLink]
                .verdict,
            Verdict::Contact);
  options.deadlineUs = -1.0;
  EXPECT_FALSE(firstContacts(c.avatar(), c.motion(), c.scene(), options).ok());
}

// Where doubles cannot resolve the tolerance, the answer says so instead of guessing.
TEST(FirstContactsResolution, IsUndecidedWhereDoublesAreTooCoarse) {
  AnalyticCase c = certainHit();
  c.placeTranslation = Vector3d(9e6, 0, 0);
  for (Triangle& t : c.triangles) {
    for (Vector3d& v : t.vertices) v += c.placeTranslation;
  }
  QueryOptions options;
  options.tolerance = 1e-9;
  const auto result = firstContacts(c.avatar(), c.motion(), c.scene(), options);
  ASSERT_TRUE(result.ok());
  const LinkContact& got = result.value().links[AnalyticCase::kLink];
  EXPECT_EQ(got.verdict, Verdict::Undecided);
  EXPECT_EQ(got.reason, UndecidedReason::Resolution);
  EXPECT_LE(got.freeUntil, *c.impact);
}

}  // namespace
}  // namespace foretouch
