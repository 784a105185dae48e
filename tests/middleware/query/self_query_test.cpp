// Own links that touch each other: sound and tight at sampled instants, at every width, for chains,
// trees and several roots; the same whatever carries the body; and what is refused.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "lss/separation.h"
#include "lss/simd.h"
#include "middleware/pair/pair_query.h"
#include "middleware/pair/query_plan.h"
#include "middleware/query/query.h"
#include "middleware/scene/scene_parts.h"
#include "middleware/scratch.h"
#include "tessellation/swept_lss.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"
#include "tests/support/name_of_simd.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::farScene;
using test::OwnBody;
using test::Random;
using test::randomOwnBody;

/// Of the LSS of two links at an instant, their radii counted.
double separationAt(const Avatar& avatar, const std::vector<LinkState>& states, LinkId a,
                    LinkId b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Lss& one : avatar.lss(a)) {
    const AxisEnds x = axisEnds(one, states[slotOf(a)]);
    for (const Lss& other : avatar.lss(b)) {
      const AxisEnds y = axisEnds(other, states[slotOf(b)]);
      least =
          std::min(least, separation(Hull::segment(x.a, x.b), Hull::segment(y.a, y.b)).distance -
                              (one.radius + other.radius));
    }
  }
  return least;
}

struct PromiseTally {
  int clear = 0, contact = 0, start = 0, undecided = 0;
};

/// Every asked pair at sampled instants from `begin` on: nothing touches before its contact, and at
/// its contact it is within the tolerance.
void expectPromise(const OwnBody& body, const PairRules& rules, const StepContacts& step,
                   double tolerance, PromiseTally& tally, double begin = 0.0) {
  constexpr int kSamples = 200;
  constexpr double kRounding = 1e-10;
  std::map<std::pair<LinkId, LinkId>, const PairContact*> found;
  for (const PairContact& contact : step.pairs) {
    EXPECT_LT(contact.link, contact.other);
    EXPECT_TRUE(found.emplace(std::make_pair(contact.link, contact.other), &contact).second);
    EXPECT_EQ(rules.reasonOf(contact.link, contact.other), PairReason::Asked);
  }
  const ChainMotion motion = body.motion();
  std::vector<LinkState> states;
  for (int k = 0; k <= kSamples; ++k) {
    const double t = begin + (1.0 - begin) * k / kSamples;
    motion.statesAt(t, states);
    for (LinkId a = 0; a < body.avatar.numLinks(); ++a) {
      for (LinkId b = a + 1; b < body.avatar.numLinks(); ++b) {
        if (body.avatar.lss(a).empty() || body.avatar.lss(b).empty() ||
            rules.reasonOf(a, b) != PairReason::Asked) {
          continue;
        }
        const auto contact = found.find({a, b});
        const double free = contact == found.end() ? 2.0 : contact->second->freeUntil;
        if (t < free) {
          EXPECT_GT(separationAt(body.avatar, states, a, b), -kRounding)
              << a << ' ' << b << " at " << t;
        }
      }
    }
  }
  for (const auto& [links, contact] : found) {
    SCOPED_TRACE(std::to_string(links.first) + " and " + std::to_string(links.second));
    motion.statesAt(contact->freeUntil, states);
    const double separation = separationAt(body.avatar, states, links.first, links.second);
    if (contact->verdict == Verdict::Contact) {
      ++tally.contact;
      EXPECT_LE(separation, tolerance + kRounding);
      EXPECT_GE(separation, -kRounding);
      EXPECT_NEAR(contact->separation, separation, kRounding + 1e-9 * tolerance);
      EXPECT_NEAR((contact->p_WLink - contact->p_WScene).dot(contact->nhat_SL_W), separation, 1e-9);
    } else if (contact->verdict == Verdict::StartsInContact) {
      ++tally.start;
      EXPECT_EQ(contact->toi, begin);
      EXPECT_LE(separation, kRounding);
      EXPECT_NEAR(contact->penetration, -separation, kRounding);
    } else {
      ++tally.undecided;
    }
  }
  tally.clear += static_cast<int>(rules.numAsked()) - static_cast<int>(found.size());
}

class SelfQueries : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

TEST_P(SelfQueries, AreSoundAndTight) {
  PromiseTally tally;
  Scratch scratch;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-7, 1e-2);
    options.self = rules.value();
    const StepContacts step =
        test::answerOf(body.avatar, body.motion(), farScene(), options, scratch);
    ASSERT_TRUE(step.arePairsAnswered);
    expectPromise(body, rules.value(), step, options.tolerance, tally);
  }
  EXPECT_GT(tally.clear, 2000);
  EXPECT_GT(tally.contact, 200);
  EXPECT_GT(tally.start, 200);
  EXPECT_EQ(tally.undecided, 0);
}

/// Of the meshes of two links, or of the LSS of one that has none, at an instant.
double surfaceSeparationAt(const Avatar& avatar, const std::vector<std::vector<Triangle>>& meshes,
                           const std::vector<LinkState>& states, LinkId a, LinkId b) {
  const auto partsOf = [&](LinkId link) {
    std::vector<std::pair<Hull, double>> parts;
    const LinkState& state = states[slotOf(link)];
    for (Triangle triangle : meshes[slotOf(link)]) {
      for (Vector3d& v : triangle.vertices) v = state.pointAt(v);
      parts.emplace_back(Hull::of(triangle), 0.0);
    }
    for (const Lss& lss : avatar.lss(link)) {
      if (!meshes[slotOf(link)].empty()) break;
      const AxisEnds ends = axisEnds(lss, state);
      parts.emplace_back(Hull::segment(ends.a, ends.b), lss.radius);
    }
    return parts;
  };
  double least = std::numeric_limits<double>::infinity();
  const auto ones = partsOf(a), others = partsOf(b);
  for (const auto& [hull, radius] : ones) {
    for (const auto& [other, otherRadius] : others) {
      least = std::min(least, separation(hull, other).distance - (radius + otherRadius));
    }
  }
  return least;
}

// At exact fidelity the meshes decide, and where a link has none its LSS; with policies each side
// has its own. What is clear at link fidelity is clear exactly, and nothing is earlier.
// A question may begin within a motion: whoever touches there starts in contact, whatever was
// before.
TEST_P(SelfQueries, FromAnInstantOnAreSoundAndTight) {
  PromiseTally tally;
  Scratch scratch;
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    OwnBody body = randomOwnBody(random);
    // All of it would mostly take several spans of time.
    Pose near;
    body.motion().poseAt(random.uniform(0.05, 0.3), near);
    body.steps.to = near;
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-5, 1e-2);
    options.self = rules.value();
    const auto plan = internal::QueryPlan::make(body.avatar, farScene(), options).value();
    std::vector<internal::LssIndexPair> meeting;
    std::vector<internal::PlanePair> open;
    for (std::int32_t x = 0; x < plan.table.size(); ++x) {
      for (std::int32_t y = x + 1; y < plan.table.size(); ++y) {
        meeting.push_back({x, y});
        open.push_back({x, y, 0, 0.0F, 0.0F, internal::kEveryPiece});
      }
    }
    const ChainMotion motion = body.motion();
    scratch.of<internal::QueryMemory>().beginStep(motion);
    const internal::WorkMeter meter(plan.options);
    const double begin = random.uniform(0.01, 0.99);
    StepContacts step;
    const internal::PairPlan own{plan, plan, plan.self, 0.0, plan.scene.parts().origin};
    internal::PairQuery query(own, {motion, motion}, meter, scratch.of<internal::QueryMemory>());
    if (!query.runAmongFrom(begin, {meeting.data(), meeting.size(), open.data(), open.size()},
                            step)) {
      ++refused;
      continue;
    }
    expectPromise(body, *options.self, step, options.tolerance, tally, begin);
  }
  EXPECT_LT(refused, 300);
  EXPECT_GT(tally.clear, 500);
  EXPECT_GT(tally.contact, 50);
  EXPECT_GT(tally.start, 30);
  EXPECT_EQ(tally.undecided, 0);
}

TEST_P(SelfQueries, OfMeshesAreSoundTightAndNeverEarlierThanTheirLss) {
  constexpr int kSamples = 60;
  constexpr double kRounding = 1e-10;
  int contacts = 0, starts = 0, clearer = 0;
  Scratch scratch;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    auto meshes = test::meshWithin(body.avatar, random, 4, 0.9);
    for (auto& mesh : meshes) {
      if (random.chance(0.2)) mesh.clear();
    }
    QueryOptions options;
    options.tolerance = random.magnitude(1e-6, 5e-3);
    options.self = rules.value();
    options.surface = AvatarSurface::build(body.avatar, meshes).value();
    if (random.chance(0.5)) {
      options.fidelity = Fidelity::Exact;
    } else {
      for (auto& mesh : meshes) {
        const bool isExact = random.chance(0.6);
        options.linkPolicies.push_back(
            {options.tolerance, isExact ? Fidelity::Exact : Fidelity::Link});
        if (!isExact) mesh.clear();
      }
    }
    const ChainMotion motion = body.motion();
    const StepContacts step = test::answerOf(body.avatar, motion, farScene(), options, scratch);
    QueryOptions bounds;
    bounds.tolerance = options.tolerance;
    bounds.self = rules.value();
    const StepContacts outer = test::answerOf(body.avatar, motion, farScene(), bounds, scratch);
    ASSERT_TRUE(step.arePairsAnswered);
    std::map<std::pair<LinkId, LinkId>, PairContact> found, above;
    for (const PairContact& c : step.pairs) found.emplace(std::make_pair(c.link, c.other), c);
    for (const PairContact& c : outer.pairs) above.emplace(std::make_pair(c.link, c.other), c);
    clearer += static_cast<int>(above.size()) - static_cast<int>(found.size());
    std::vector<LinkState> states;
    for (const auto& [links, bound] : above) {
      const auto contact = found.find(links);
      const double free = contact == found.end() ? 2.0 : contact->second.freeUntil;
      EXPECT_GE(free, bound.freeUntil);
      for (int k = 0; k <= kSamples; ++k) {
        const double t = static_cast<double>(k) / kSamples;
        if (t >= free) break;
        motion.statesAt(t, states);
        EXPECT_GT(surfaceSeparationAt(body.avatar, meshes, states, links.first, links.second),
                  -kRounding);
      }
    }
    for (const auto& [links, contact] : found) {
      EXPECT_EQ(above.count(links), 1U);
      motion.statesAt(contact.freeUntil, states);
      const double apart =
          surfaceSeparationAt(body.avatar, meshes, states, links.first, links.second);
      ASSERT_NE(contact.verdict, Verdict::Undecided);
      EXPECT_LE(apart,
                contact.verdict == Verdict::Contact ? options.tolerance + kRounding : kRounding);
      (contact.verdict == Verdict::Contact ? contacts : starts) += 1;
    }
  }
  EXPECT_GT(contacts, 60);
  EXPECT_GT(starts, 30);
  EXPECT_GT(clearer, 30);
}

// Deeper than at rest is still told: two LSS with a pair radius touch when they come nearer than
// they rest, and not before.
TEST_P(SelfQueries, WithPairRadiiTellWhatIsDeeperThanAtRest) {
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero()},
                {"b", 0, Vector3d(1, 0, 0)},
                {"c", 1, Vector3d(-0.92, 0, 0)}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.05};
  const Avatar avatar =
      Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}, {ball}}).value();
  PairRuleOptions derived;
  derived.usePairRadii = true;
  derived.restSkin = 0.01;
  QueryOptions options;
  options.self = PairRules::derive(avatar, derived).value();
  Scratch scratch;
  Pose nearer = restPose(avatar.skeleton()), farther = nearer;
  nearer.translations[2].x() = -0.98;
  farther.translations[2].x() = -0.7;
  const auto pairsOf = [&](const Pose& to) {
    const ChainMotion motion(avatar.skeleton(), restPose(avatar.skeleton()), to);
    return test::answerOf(avatar, motion, farScene(), options, scratch).pairs;
  };
  EXPECT_TRUE(pairsOf(farther).empty());
  const auto touching = pairsOf(nearer);
  ASSERT_EQ(touching.size(), 1U);
  EXPECT_EQ(touching[0].verdict, Verdict::Contact);
  // From 8 cm towards 2 cm, with 7 cm for the radii.
  EXPECT_NEAR(touching[0].toi, (0.08 - 0.07) / 0.06, 0.02);
}

// A budget that is spent leaves pairs undecided, free as far as proven, and never clear.
TEST_P(SelfQueries, WithoutWorkAreUndecidedAndNeverClearThatTouch) {
  int undecided = 0;
  Scratch scratch;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const OwnBody body = randomOwnBody(random);
    const auto rules = PairRules::derive(body.avatar);
    if (!rules.ok()) continue;
    QueryOptions options;
    options.self = rules.value();
    const StepContacts whole =
        test::answerOf(body.avatar, body.motion(), farScene(), options, scratch);
    options.workBudget = static_cast<std::uint64_t>(random.magnitude(1.0, 1e4));
    const StepContacts cut =
        test::answerOf(body.avatar, body.motion(), farScene(), options, scratch);
    std::map<std::pair<LinkId, LinkId>, PairContact> told;
    for (const PairContact& c : cut.pairs) told.emplace(std::make_pair(c.link, c.other), c);
    for (const PairContact& contact : whole.pairs) {
      const auto found = told.find({contact.link, contact.other});
      ASSERT_NE(found, told.end()) << "it touches, so nothing may say that it is clear";
      EXPECT_LE(found->second.freeUntil, contact.freeUntil);
    }
    for (const PairContact& contact : cut.pairs) {
      undecided += contact.reason == UndecidedReason::WorkBudget ? 1 : 0;
    }
  }
  EXPECT_GT(undecided, 50);
}

// Of a hundred pairs of balls that all but touch, one overlaps, so the links start in contact:
// whoever has not looked at all of them may not say that they only touch. What makes meshes of the
// links is far away.
TEST_P(SelfQueries, WithoutWorkNeverTakeAStartInContactForATouch) {
  constexpr int kBalls = 100;
  constexpr double kRadius = 0.1;
  const RawSkeleton raw{{{"a", kNoParent, Vector3d::Zero()}, {"b", 0, Vector3d::Zero()}}};
  const Vector3d below(0, -30, 0), above(0, 30, 0), dx(0.01, 0, 0), dz(0, 0, 0.01);
  Scratch scratch;
  for (const int deepest : {0, 50, 99}) {
    QueryOptions options;
    std::vector<Lss> one{{below, below, kRadius}}, other{{above, above, kRadius}};
    for (int i = 0; i < kBalls; ++i) {
      const double gap = i == deepest ? -0.05 : 0.3 * options.tolerance;
      const Vector3d x(i, 0, 0), y(i, 2.0 * kRadius + gap, 0);
      one.push_back({x, x, kRadius});
      other.push_back({y, y, kRadius});
    }
    const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {one, other}).value();
    options.self = PairRules::asking(avatar, {{0, 1}}).value();
    options.fidelity = Fidelity::Exact;
    options.surface = AvatarSurface::build(avatar, {{{{below, below + dx, below + dz}}},
                                                    {{{above, above + dx, above + dz}}}})
                          .value();
    const Pose from = restPose(avatar.skeleton());
    Pose to = from;
    to.translations[1].y() += 0.02;
    const ChainMotion motion(avatar.skeleton(), from, to);
    int told = 0, undecided = 0;
    for (std::uint64_t budget = 1; budget < 20'000; budget += 1 + budget / 8) {
      SCOPED_TRACE(budget);
      options.workBudget = budget;
      const auto pairs = test::answerOf(avatar, motion, farScene(), options, scratch).pairs;
      ASSERT_EQ(pairs.size(), 1u);
      const bool isDecided = pairs[0].verdict != Verdict::Undecided;
      EXPECT_EQ(pairs[0].verdict, isDecided ? Verdict::StartsInContact : Verdict::Undecided);
      ++(isDecided ? told : undecided);
    }
    EXPECT_GT(told, 3);
    EXPECT_GT(undecided, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, SelfQueries, testing::ValuesIn(supportedSimd()), test::nameOfSimd);

}  // namespace
}  // namespace foretouch
