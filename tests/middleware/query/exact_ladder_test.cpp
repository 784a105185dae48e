// Exact fidelity beside link fidelity: a subset of its contacts, and never earlier; independent of
// culler and of the scene's order; the surface's own refusals.
#include <algorithm>
#include <numeric>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/reference_query.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

bool touches(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

struct Bench {
  test::RandomBody body;
  Scene scene;
  QueryOptions link, exact;
  ReferenceOptions reference;
};

Bench makeBench(int seed, double share) {
  Random random(static_cast<std::uint64_t>(seed));
  Bench bench{test::bodyInClutter(random, 6, Vector3d::Zero()),
              Scene::build(test::clutter(random, 600, 5, Vector3d::Zero())).value(),
              {},
              {},
              {}};
  bench.link.tolerance = random.magnitude(1e-6, 1e-2);
  bench.exact = bench.link;
  bench.exact.fidelity = Fidelity::Exact;
  bench.exact.surface = AvatarSurface::build(bench.body.avatar,
                                             test::meshWithin(bench.body.avatar, random, 40, share))
                            .value();
  return bench;
}

TEST(ExactFidelity, ContactsAreASubsetOfTheLssContactsAndNeverEarlier) {
  int refuted = 0, later = 0, starts = 0, contacts = 0;
  for (int seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    const Bench bench = makeBench(seed, 0.8);
    const auto motion = bench.body.motion();
    const auto link = firstContacts(bench.body.avatar, motion, bench.scene, bench.link).value();
    const auto exact =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    for (std::size_t i = 0; i < link.links.size(); ++i) {
      const LinkContact &l = link.links[i], &e = exact.links[i];
      ASSERT_NE(e.verdict, Verdict::Undecided);
      if (!touches(e)) {
        refuted += touches(l) ? 1 : 0;
        continue;
      }
      ASSERT_TRUE(touches(l)) << "a mesh touches what its LSS does not";
      ASSERT_GE(e.toi, l.toi);
      ++contacts;
      later += e.toi > l.toi ? 1 : 0;
      starts += e.verdict == Verdict::StartsInContact ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(refuted, 20);
  EXPECT_GT(later, 50);
  EXPECT_GT(starts, 20);
}

// The query's own hierarchy against every triangle pair, sampled in time: what the mesh touches at
// any sampled instant, the answer has found by then.
TEST(ExactFidelity, NoSampledTouchIsMissedOrEarlierThanReported) {
  int seen = 0;
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Bench bench = makeBench(1000 + seed, 0.9);
    const auto motion = bench.body.motion();
    const auto exact =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    Scratch scratch;
    for (LinkId link = 0; link < bench.body.avatar.numLinks(); ++link) {
      const LinkContact& got = exact.links[static_cast<std::size_t>(link)];
      for (int k = 0; k <= 60; ++k) {
        const double t = k / 60.0;
        if (!test::touchesAt(bench.body.avatar, motion, link, t, bench.scene, bench.exact,
                             scratch)) {
          continue;
        }
        ++seen;
        ASSERT_TRUE(touches(got)) << "missed at " << t;
        ASSERT_LE(got.toi, t) << "late";
      }
    }
  }
  EXPECT_GT(seen, 50);
}

/// Every width of the processor, one after the other.
class ExactInLanes : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// Both keep the promise, and it leaves little room: where one finds contact and the other none,
/// the separation is above 0 and within the tolerance.
void expectWithinThePromise(const LinkContact& lanes, const LinkContact& doubles, double tolerance,
                            int& differ) {
  ASSERT_NE(lanes.verdict, Verdict::Undecided);
  if (lanes.verdict != doubles.verdict) {
    ++differ;
    const LinkContact& found = touches(lanes) ? lanes : doubles;
    ASSERT_EQ(found.verdict, Verdict::Contact) << "only contact from outside leaves a choice";
    ASSERT_GT(found.separation, 0.2 * tolerance);
  }
  if (touches(lanes)) {
    ASSERT_LE(lanes.separation, tolerance);
  }
  if (lanes.verdict != Verdict::StartsInContact || doubles.verdict != lanes.verdict) return;
  EXPECT_EQ(lanes.triangle, doubles.triangle);
  EXPECT_EQ(lanes.linkTriangle, doubles.linkTriangle);
  EXPECT_EQ(lanes.p_WLink, doubles.p_WLink);
  EXPECT_EQ(lanes.p_WScene, doubles.p_WScene);
}

TEST_P(ExactInLanes, AgreeWithDoublesWithinThePromise) {
  int starts = 0, contacts = 0, clear = 0, differ = 0;
  for (int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Bench bench = makeBench(2000 + seed, 0.95);
    const auto motion = bench.body.motion();
    const auto lanes =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    bench.reference.backtracking = Backtracking::Scalar;
    const auto doubles =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    ASSERT_GT(lanes.counters.candidates, 0U);
    for (std::size_t i = 0; i < lanes.links.size(); ++i) {
      expectWithinThePromise(lanes.links[i], doubles.links[i], bench.exact.tolerance, differ);
      starts += lanes.links[i].verdict == Verdict::StartsInContact ? 1 : 0;
      contacts += lanes.links[i].verdict == Verdict::Contact ? 1 : 0;
      clear += lanes.links[i].verdict == Verdict::Clear ? 1 : 0;
    }
  }
  EXPECT_GT(starts, 40);
  EXPECT_GT(contacts, 100);
  EXPECT_GT(clear, 100);
  RecordProperty("verdictsThatDiffer", differ);
  EXPECT_LE(differ, 3);
}

TEST_P(ExactInLanes, MissNoSampledTouchAndAreNotLate) {
  int seen = 0;
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    const Bench bench = makeBench(3000 + seed, 0.95);
    const auto motion = bench.body.motion();
    const auto exact =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    Scratch scratch;
    for (LinkId link = 0; link < bench.body.avatar.numLinks(); ++link) {
      const LinkContact& got = exact.links[static_cast<std::size_t>(link)];
      for (int k = 0; k <= 60; ++k) {
        const double t = k / 60.0;
        if (!test::touchesAt(bench.body.avatar, motion, link, t, bench.scene, bench.exact,
                             scratch)) {
          continue;
        }
        ++seen;
        ASSERT_TRUE(touches(got)) << "missed at " << t;
        ASSERT_LE(got.toi, t) << "late";
      }
    }
  }
  EXPECT_GT(seen, 30);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, ExactInLanes, testing::ValuesIn(supportedSimd()),
                         [](const testing::TestParamInfo<Simd>& simd) {
                           return std::string(toString(simd.param));
                         });

TEST(ExactFidelity, AnswersAlikeWithEitherCullerAndAnyOrderOfTheScene) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Bench bench = makeBench(seed, 0.8);
    const auto motion = bench.body.motion();
    const auto first =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    bench.reference.culler = Culler::PointQuery;
    const auto second =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();

    RawScene shuffled;
    std::vector<TriangleId> order(bench.scene.numTriangles());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<unsigned>(seed)));
    for (const TriangleId id : order) {
      shuffled.triangles.push_back(bench.scene.triangle(id));
      shuffled.objectOf.push_back(bench.scene.object(id));
    }
    shuffled.objectNames = bench.scene.objectNames();
    const Scene other = Scene::build(std::move(shuffled)).value();
    const auto third = firstContacts(bench.body.avatar, motion, other, bench.exact).value();
    for (std::size_t i = 0; i < first.links.size(); ++i) {
      for (const LinkContact* got : {&second.links[i], &third.links[i]}) {
        ASSERT_EQ(got->verdict, first.links[i].verdict);
        EXPECT_EQ(got->toi, first.links[i].toi);
        EXPECT_EQ(got->separation, first.links[i].separation);
        EXPECT_EQ(got->linkTriangle, first.links[i].linkTriangle);
        EXPECT_EQ(got->p_WLink, first.links[i].p_WLink);
        EXPECT_EQ(got->p_WScene, first.links[i].p_WScene);
      }
    }
  }
}

/// Free is free up to the touch itself, which a thousandth of the tolerance finds nearly; contacts
/// may be found at other instants within the tolerance.
void judgeSpentBudgets(Backtracking backtracking) {
  constexpr double kAfterTheTouch = 1e-6;  // of the step
  int undecided = 0;
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Bench bench = makeBench(seed, 0.8);
    bench.reference.backtracking = backtracking;
    const auto motion = bench.body.motion();
    QueryOptions fine = bench.exact;
    fine.tolerance *= 1e-3;
    const auto touch =
        firstContacts(bench.body.avatar, motion, bench.scene, fine, bench.reference).value();
    for (const std::uint64_t budget : {100u, 1000u, 5000u}) {
      bench.exact.workBudget = budget;
      const auto cut =
          firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference)
              .value();
      for (std::size_t i = 0; i < touch.links.size(); ++i) {
        EXPECT_LE(cut.links[i].freeUntil, touch.links[i].freeUntil + kAfterTheTouch);
        undecided += cut.links[i].verdict == Verdict::Undecided ? 1 : 0;
      }
    }
  }
  EXPECT_GT(undecided, 30);
}

TEST(ExactFidelity, SpentBudgetIsUndecidedAndNeverLateInDoubles) {
  judgeSpentBudgets(Backtracking::Scalar);
}

TEST(ExactFidelity, SpentBudgetIsUndecidedAndNeverLateInLanes) {
  judgeSpentBudgets(Backtracking::Lanes);
}

TEST(ExactFidelity, CountsWhatItDescendedInLanes) {
  if (activeSimd() == Simd::Scalar) GTEST_SKIP() << "a single lane: doubles descend";
  const Bench bench = makeBench(3, 0.8);
  const auto exact = firstContacts(bench.body.avatar, bench.body.motion(), bench.scene, bench.exact,
                                   bench.reference)
                         .value();
  EXPECT_GT(exact.counters.partSteps, 0u);
  EXPECT_GT(exact.counters.leafTests, 0u) << "contact is for doubles to say";
  EXPECT_GT(exact.counters.partSteps, 10 * exact.counters.advancements);
  EXPECT_EQ(exact.counters.advancements, exact.counters.hierarchyTests + exact.counters.leafTests);
}

TEST(ExactFidelity, CountsWhatItDescendedInDoubles) {
  Bench bench = makeBench(3, 0.8);
  bench.reference.backtracking = Backtracking::Scalar;
  const auto exact = firstContacts(bench.body.avatar, bench.body.motion(), bench.scene, bench.exact,
                                   bench.reference)
                         .value();
  EXPECT_EQ(exact.counters.partSteps, 0u);
  EXPECT_GT(exact.counters.hierarchyTests, 0u);
  EXPECT_GT(exact.counters.planeTests, 0u);
  EXPECT_GT(exact.counters.leafTests, 0u);
  EXPECT_EQ(exact.counters.advancements, exact.counters.hierarchyTests + exact.counters.leafTests);
}

Avatar sphereAvatar() {
  RawSkeleton raw;
  raw.joints = {{"ball", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  return Avatar::build(Skeleton::build(raw).value(), {{{Vector3d::Zero(), Vector3d::Zero(), 1.0}}})
      .value();
}

TEST(AvatarSurface, RefusesTrianglesOutsideTheLssNamingTheLinkAndHowFar) {
  const Triangle inside{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}};
  Triangle outside = inside;
  outside.vertices[1].x() = 1.25;
  ASSERT_TRUE(AvatarSurface::build(sphereAvatar(), {{inside}}).ok());
  const auto refused = AvatarSurface::build(sphereAvatar(), {{inside, outside}});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().index, 0);
  EXPECT_NE(refused.error().message.find("'ball'"), std::string::npos);
  EXPECT_NE(refused.error().message.find("triangle 1 is 0.25 m outside"), std::string::npos);
}

TEST(AvatarSurface, RefusesWhatIsNotASurface) {
  Triangle nan{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}};
  nan.vertices[2].y() = std::nan("");
  EXPECT_EQ(AvatarSurface::build(sphereAvatar(), {{nan}}).error().code, ErrorCode::NonFinite);
  EXPECT_EQ(AvatarSurface::build(sphereAvatar(), {}).error().code, ErrorCode::Mismatch);
}

// What no mesh models is modelled by its LSS: a robot's capsule beside links with meshes.
TEST(ExactFidelity, AnLssWithoutTrianglesStandsForItself) {
  int contacts = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Bench bench = makeBench(seed, 0.8);
    const std::vector<std::vector<Triangle>> none(
        static_cast<std::size_t>(bench.body.avatar.numLinks()));
    bench.exact.surface = AvatarSurface::build(bench.body.avatar, none).value();
    const auto motion = bench.body.motion();
    const auto link = firstContacts(bench.body.avatar, motion, bench.scene, bench.link).value();
    const auto exact =
        firstContacts(bench.body.avatar, motion, bench.scene, bench.exact, bench.reference).value();
    Scratch scratch;
    for (std::size_t i = 0; i < link.links.size(); ++i) {
      ASSERT_EQ(exact.links[i].verdict, link.links[i].verdict);
      ASSERT_EQ(exact.links[i].toi, link.links[i].toi);
      contacts += touches(link.links[i]) ? 1 : 0;
      for (const double t : {0.0, 0.5, 1.0}) {
        const auto l = static_cast<LinkId>(i);
        EXPECT_EQ(
            test::touchesAt(bench.body.avatar, motion, l, t, bench.scene, bench.exact, scratch),
            test::touchesAt(bench.body.avatar, motion, l, t, bench.scene, bench.link, scratch));
      }
    }
  }
  EXPECT_GT(contacts, 60);
}

TEST(ExactFidelity, NeedsTheSurfaceOfTheAvatar) {
  const Bench bench = makeBench(1, 0.8);
  QueryOptions options;
  options.fidelity = Fidelity::Exact;
  const auto without = firstContacts(bench.body.avatar, bench.body.motion(), bench.scene, options);
  ASSERT_FALSE(without.ok());
  EXPECT_EQ(without.error().file, "fidelity");
}

}  // namespace
}  // namespace foretouch
