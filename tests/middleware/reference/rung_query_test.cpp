// Queries by volumes around several links: each volume's answer by the oracle that judges LSS, the
// order of the rungs' answers, ignored pairs, determinism, and Descent::ByNeed.
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "judge/judge.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/reference/random_step.h"
#include "tests/reference/reference_query.h"
#include "tests/reference/rungs.h"
#include "tests/support/asked.h"
#include "tests/support/judged_answer.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;
using test::RandomStep;

constexpr std::array<Rung, 3> kRungs{Rung::Ellipsoid, Rung::Avatar, Rung::Limb};
/// Those, and last the links themselves.
constexpr std::array<std::optional<Rung>, 4> kLadder{Rung::Ellipsoid, Rung::Avatar, Rung::Limb,
                                                     std::nullopt};

/// A body near few triangles, so that its volumes do not always touch something at once.
struct Case {
  RandomStep step;
  RawScene raw;
  Scene scene;
};
Case someCase(int i, int triangles) {
  Random random(static_cast<std::uint64_t>(i));
  const Vector3d center =
      i % 6 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
  RawScene raw = test::clutter(random, triangles, 3, center);
  const RandomStep step = test::randomStep(random, 1 + random.below(9), i % 3 != 0,
                                           center + random.uniform(0.5, 3.0) * random.direction());
  return {step, raw, Scene::build(raw).value()};
}

QueryOptions within(double tolerance) {
  QueryOptions options;
  options.tolerance = tolerance;
  return options;
}

ReferenceOptions by(std::optional<Rung> rung) {
  ReferenceOptions reference;
  reference.rung = rung;
  return reference;
}

StepContacts answer(const Case& c, const QueryOptions& options, const ReferenceOptions& reference) {
  return firstContacts(c.step.avatar, c.step.motion(), c.scene, options, reference).value();
}

class RungQueries : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

TEST_P(RungQueries, AreSoundAndTightByTheOracle) {
  std::array<int, 4> verdicts{};
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    const Case c = someCase(i, 16);
    const oracle::Scene scene(test::plain(c.raw.triangles));
    const oracle::Motion truth(test::plainJoints(c.step.avatar.skeleton(), c.step.from, c.step.to));
    for (const Rung rung : {Rung::Limb, Rung::Avatar}) {
      const QueryOptions options = within(std::array<double, 3>{1e-2, 1e-3, 1e-6}[i % 3]);
      ReferenceOptions reference = by(rung);
      if (i % 4 == 0) reference.backtracking = Backtracking::Scalar;
      const StepContacts got = answer(c, options, reference);
      for (const RungVolume& volume : rungVolumes(c.step.avatar, c.step.motion(), c.scene, rung)) {
        const std::vector<oracle::Capsule> capsule{test::plain(volume.lss)};
        const LinkContact& first = got.links[static_cast<std::size_t>(volume.links.front())];
        const oracle::Judgement judgement = oracle::Judge(scene, truth, volume.carrier, capsule)
                                                .judge(test::plain(first), options.tolerance);
        EXPECT_EQ(judgement.finding, oracle::Finding::Ok)
            << toString(rung) << " of " << volume.carrier << ": " << toString(judgement.finding)
            << " " << judgement.what;
        ++verdicts[static_cast<std::size_t>(first.verdict)];
        for (const LinkId link : volume.links) {
          const LinkContact& same = got.links[static_cast<std::size_t>(link)];
          EXPECT_EQ(same.link, link);
          EXPECT_EQ(same.verdict, first.verdict);
          EXPECT_EQ(same.toi, first.toi);
          EXPECT_EQ(same.p_WScene, first.p_WScene);
        }
      }
      for (LinkId link = 0; link < c.step.avatar.numLinks(); ++link) {
        if (!c.step.avatar.lss(link).empty()) continue;
        EXPECT_EQ(got.links[static_cast<std::size_t>(link)].verdict, Verdict::Clear);
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Clear)], 50);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::Contact)], 50);
  EXPECT_GT(verdicts[static_cast<std::size_t>(Verdict::StartsInContact)], 50);
  EXPECT_EQ(verdicts[static_cast<std::size_t>(Verdict::Undecided)], 0);
}

// A higher rung at a coarse tolerance against a lower one at a fine one: what the higher proves
// free is so for the lower, and by more than the lower's tolerance.
TEST_P(RungQueries, AreOrderedAsTheRungsAre) {
  int clear = 0, later = 0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const Case c = someCase(1000 + i, 12);
    std::array<StepContacts, kLadder.size()> coarse, fine;
    for (std::size_t rung = 0; rung < kLadder.size(); ++rung) {
      coarse[rung] = answer(c, within(1e-3), by(kLadder[rung]));
      fine[rung] = answer(c, within(1e-7), by(kLadder[rung]));
    }
    for (std::size_t above = 0; above < kLadder.size(); ++above) {
      for (std::size_t below = above + 1; below < kLadder.size(); ++below) {
        for (std::size_t link = 0; link < coarse[above].links.size(); ++link) {
          SCOPED_TRACE(std::to_string(above) + " > " + std::to_string(below) + ", link " +
                       std::to_string(link));
          const LinkContact& high = coarse[above].links[link];
          const LinkContact& low = fine[below].links[link];
          if (high.verdict == Verdict::Clear) {
            EXPECT_EQ(low.verdict, Verdict::Clear);
            ++clear;
          }
          EXPECT_GE(low.freeUntil, high.freeUntil);
          later += low.freeUntil > high.freeUntil;
        }
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(clear, 1000);
  EXPECT_GT(later, 1000);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, RungQueries, testing::ValuesIn(supportedSimd()),
                         [](const auto& tested) { return std::string(toString(tested.param)); });

void expectSame(const LinkContact& x, const LinkContact& y) {
  EXPECT_EQ(x.verdict, y.verdict);
  EXPECT_EQ(x.reason, y.reason);
  EXPECT_EQ(x.toi, y.toi);
  EXPECT_EQ(x.freeUntil, y.freeUntil);
  EXPECT_EQ(x.separation, y.separation);
  EXPECT_EQ(x.penetration, y.penetration);
  EXPECT_EQ(x.p_WScene, y.p_WScene);
  EXPECT_EQ(x.p_WLink, y.p_WLink);
  EXPECT_EQ(x.nhat_SL_W, y.nhat_SL_W);
}

TEST(RungDeterminism, CullersTriangleOrderAndScratchDoNotShow) {
  Scratch used;
  for (int i = 0; i < 80; ++i) {
    SCOPED_TRACE(i);
    Case c = someCase(2000 + i, 40);
    std::fill(c.raw.objectOf.begin(), c.raw.objectOf.end(), 0);
    RawScene shuffled;
    shuffled.objectNames = c.raw.objectNames;
    shuffled.objectOf = c.raw.objectOf;
    shuffled.triangles = c.raw.triangles;
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(),
                 std::mt19937(static_cast<unsigned>(i)));
    const Scene other = Scene::build(shuffled).value();
    for (const Rung rung : kRungs) {
      const QueryOptions options = within(1e-4);
      const ChainMotion motion = c.step.motion();
      const auto fresh = firstContacts(c.step.avatar, motion, c.scene, options, by(rung)).value();
      const auto again = test::answerOf(c.step.avatar, motion, c.scene, options, by(rung), used);
      const auto mixed = test::answerOf(c.step.avatar, motion, other, options, by(rung), used);
      ReferenceOptions pointQuery = by(rung);
      pointQuery.culler = Culler::PointQuery;
      const auto slow = test::answerOf(c.step.avatar, motion, c.scene, options, pointQuery, used);
      for (std::size_t link = 0; link < fresh.links.size(); ++link) {
        expectSame(fresh.links[link], again.links[link]);
        expectSame(fresh.links[link], slow.links[link]);
        expectSame(fresh.links[link], mixed.links[link]);
      }
    }
    if (HasFailure()) return;
  }
}

/// Two links, both of which reach a floor.
struct TwoOnAFloor {
  Avatar avatar;
  Scene scene;
  ChainMotion motion;
};
TwoOnAFloor twoOnAFloor() {
  RawSkeleton raw;
  raw.joints.push_back({"one", kNoParent, Vector3d(0, 0.5, 0), Quaternion::Identity()});
  raw.joints.push_back({"two", 0, Vector3d(0.3, 0, 0), Quaternion::Identity()});
  const std::vector<Lss> ball{{Vector3d::Zero(), Vector3d::Zero(), 0.1}};
  Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {ball, ball}).value();
  RawScene floor;
  floor.triangles = {{{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 9)}}};
  floor.objectOf = {0};
  floor.objectNames = {"floor"};
  const Pose from = restPose(avatar.skeleton());
  Pose to = from;
  to.translations[0] -= Vector3d(0, 1, 0);
  ChainMotion motion(avatar.skeleton(), from, to);
  return {std::move(avatar), Scene::build(floor).value(), std::move(motion)};
}

TEST(RungOptions, AreHonouredOrRefusedByName) {
  const TwoOnAFloor c = twoOnAFloor();
  const auto refused = [&](QueryOptions options, const ReferenceOptions& reference) {
    const auto query = buildReference(c.avatar, c.scene, options, reference);
    return query.ok() ? std::string("accepted") : query.error().file;
  };
  const auto rules = PairRules::leavingOut(c.avatar, {});
  ASSERT_TRUE(rules.ok());
  for (const Rung rung : kRungs) {
    QueryOptions exact, policies, separating, objects, self;
    exact.fidelity = Fidelity::Exact;
    exact.surface = AvatarSurface::build(c.avatar, {{}, {}}).value();
    policies.linkPolicies.assign(2, LinkPolicy{});
    separating.passSeparating = true;
    objects.scope = Scope::EveryObject;
    self.self = rules.value();
    EXPECT_EQ(refused({}, by(rung)), "accepted");
    EXPECT_EQ(refused(exact, by(rung)), "fidelity");
    EXPECT_EQ(refused(policies, by(rung)), "linkPolicies");
    EXPECT_EQ(refused(separating, by(rung)), "passSeparating");
    EXPECT_EQ(refused(objects, by(rung)), "scope");
    EXPECT_EQ(refused(self, by(rung)), "self");
    ReferenceOptions byNeed = by(rung), scalar = by(rung), cubics = by(rung);
    byNeed.descent = Descent::ByNeed;
    scalar.backtracking = Backtracking::Scalar;
    cubics.leafMethod = LeafMethod::Cubics;
    EXPECT_EQ(refused({}, byNeed), "descent");
    EXPECT_EQ(refused({}, cubics), "leafMethod");
    EXPECT_EQ(refused({}, scalar), rung == Rung::Ellipsoid ? "backtracking" : "accepted");
  }
}

TEST(RungIgnoredPairs, AnObjectIsPassedOverOnlyWhereAllLinksIgnoreIt) {
  const TwoOnAFloor c = twoOnAFloor();
  for (const Rung rung : kRungs) {
    SCOPED_TRACE(toString(rung));
    QueryOptions options = within(1e-3);
    const auto verdicts = [&] {
      const auto got = firstContacts(c.avatar, c.motion, c.scene, options, by(rung)).value();
      return std::pair(got.links[0].verdict, got.links[1].verdict);
    };
    const std::pair both(Verdict::Contact, Verdict::Contact), none(Verdict::Clear, Verdict::Clear);
    EXPECT_EQ(verdicts(), both);
    options.ignored = {{0, 0}};
    EXPECT_EQ(verdicts(), both);
    options.ignored = {{0, 0}, {1, 0}};
    EXPECT_EQ(verdicts(), none);
    options.ignored = {{0, IgnoredPair::kEveryObject}};
    EXPECT_EQ(verdicts(), std::pair(Verdict::Clear, Verdict::Contact));
    options.ignored = {{0, IgnoredPair::kEveryObject}, {1, 0}};
    EXPECT_EQ(verdicts(), none);
  }
}

TEST(RungBudgets, AreSound) {
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Case c = someCase(3000 + i, 12);
    for (const Rung rung : kRungs) {
      const StepContacts all = answer(c, within(1e-7), by(rung));
      for (const std::uint64_t budget : {0, 100, 400, 1000}) {
        QueryOptions options = within(1e-4);
        options.workBudget = budget;
        const StepContacts got = answer(c, options, by(rung));
        for (std::size_t link = 0; link < got.links.size(); ++link) {
          // Free up to the touch itself, which is hardly later than what the least tolerance finds.
          EXPECT_LE(got.links[link].freeUntil, all.links[link].freeUntil + 1e-6);
          if (got.links[link].verdict == Verdict::Clear) {
            EXPECT_EQ(all.links[link].verdict, Verdict::Clear);
          }
        }
      }
    }
  }
}

TEST(DescentByNeed, GivesTheSameAnswers) {
  std::uint64_t settled = 0, asked = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    const Case c = someCase(4000 + i, 20);
    const QueryOptions options = within(i % 2 == 0 ? 1e-3 : 0.05);
    ReferenceOptions reference;
    if (i % 5 == 0) reference.backtracking = Backtracking::Scalar;
    const StepContacts straight = answer(c, options, reference);
    reference.descent = Descent::ByNeed;
    const StepContacts byNeed = answer(c, options, reference);
    EXPECT_EQ(byNeed.counters.rungTests, 1U);
    settled += byNeed.counters.settledAbove > 0;
    ++asked;
    for (std::size_t link = 0; link < straight.links.size(); ++link) {
      expectSame(straight.links[link], byNeed.links[link]);
    }
  }
  EXPECT_GT(settled, asked / 20);
  EXPECT_LT(settled, asked);
}

}  // namespace
}  // namespace foretouch
