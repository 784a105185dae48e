// Two bodies that nothing joins, asked as two sides that move: the same answers to the last bit as
// of one chain that has both, whose own links are asked.
#include "middleware/pair/pair_query.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/pair_rules.h"
#include "middleware/pair/lane_cull.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/work_meter.h"
#include "middleware/scratch.h"
#include "tests/middleware/own_body.h"
#include "tests/support/asked.h"

namespace foretouch {
namespace {

using internal::PairPlan;
using internal::PairsAsked;
using internal::SidePlan;
using test::OwnBody;
using test::Random;
using test::randomOwnBody;

/// The joints of both, the second one's after the first one's.
OwnBody joined(const OwnBody& one, const OwnBody& other) {
  RawSkeleton raw;
  OwnBody both = one;
  std::vector<std::vector<Lss>> lss;
  for (const OwnBody* const part : {&one, &other}) {
    const Skeleton& own = part->avatar.skeleton();
    const auto first = static_cast<JointId>(raw.joints.size());
    for (JointId joint = 0; joint < own.numJoints(); ++joint) {
      const JointId parent = own.parent(joint) == kNoParent ? kNoParent : own.parent(joint) + first;
      raw.joints.push_back({std::to_string(raw.joints.size()), parent, own.restOffset(joint),
                            own.restRotation(joint)});
      lss.push_back(part->avatar.lss(joint));
    }
  }
  for (const auto& [pose, more] : {std::pair{&both.steps.from, &other.steps.from},
                                   std::pair{&both.steps.to, &other.steps.to}}) {
    pose->rotations.insert(pose->rotations.end(), more->rotations.begin(), more->rotations.end());
    pose->translations.insert(pose->translations.end(), more->translations.begin(),
                              more->translations.end());
  }
  both.steps.skeleton = Skeleton::build(raw).value();
  both.avatar = Avatar::build(both.steps.skeleton, lss).value();
  return both;
}

/// Of the chain of both, only pairs of the one and the other.
PairRules rulesBetween(const Avatar& both, LinkId numOfOne) {
  std::vector<LeftOutPair> leftOut;
  for (LinkId a = 0; a < both.numLinks(); ++a) {
    for (LinkId b = a + 1; b < both.numLinks(); ++b) {
      const bool isAsked = a < numOfOne && b >= numOfOne;
      if (isAsked || both.lss(a).empty() || both.lss(b).empty()) continue;
      leftOut.push_back({a, b, PairReason::User});
    }
  }
  return PairRules::leavingOut(both, std::move(leftOut)).value();
}

void expectSame(const StepContacts& one, const StepContacts& two, LinkId numOfOne) {
  ASSERT_EQ(one.pairs.size(), two.pairs.size());
  EXPECT_EQ(one.arePairsAnswered, two.arePairsAnswered);
  EXPECT_EQ(one.provenClearance, two.provenClearance);
  for (std::size_t i = 0; i < one.pairs.size(); ++i) {
    const PairContact &x = one.pairs[i], &y = two.pairs[i];
    EXPECT_EQ(x.link, y.link);
    EXPECT_EQ(x.other, y.other + numOfOne);
    EXPECT_EQ(x.verdict, y.verdict);
    EXPECT_EQ(x.freeUntil, y.freeUntil);
    EXPECT_EQ(x.toi, y.toi);
    EXPECT_EQ(x.separation, y.separation);
    EXPECT_EQ(x.penetration, y.penetration);
    EXPECT_EQ(x.lss, y.lss);
    EXPECT_EQ(x.otherLss, y.otherLss);
    EXPECT_EQ(x.p_WLink, y.p_WLink);
    EXPECT_EQ(x.p_WScene, y.p_WScene);
    EXPECT_EQ(x.nhat_SL_W, y.nhat_SL_W);
  }
}

TEST(PairQuery, TwoChainsAnswerAsOneThatHasBoth) {
  Random random(20261128);
  Scratch scratch;
  int contacts = 0, starts = 0, left = 0, inSlabs = 0;
  for (int i = 0; i < 600; ++i) {
    const OwnBody one = randomOwnBody(random), other = randomOwnBody(random);
    const OwnBody both = joined(one, other);
    const double startShare = i % 3 == 0 ? 0.5 : 0.0;
    QueryOptions options;
    options.tolerance = random.magnitude(1e-5, 1e-2);
    const SidePlan sideOfOne = SidePlan::make(one.avatar, options).value();
    const SidePlan sideOfOther = SidePlan::make(other.avatar, options).value();
    options.self = rulesBetween(both.avatar, one.avatar.numLinks());
    const SidePlan sideOfBoth = SidePlan::make(both.avatar, options).value();
    const PairsAsked ofOne(both.avatar, sideOfBoth.table, *options.self);
    const PairsAsked ofTwo(sideOfOne.table, sideOfOther.table);
    const internal::WorkMeter meter(options);

    const ChainMotion motion = both.motion();
    StepContacts asOne;
    internal::beginAnswer(asOne);
    scratch.of<internal::QueryMemory>().beginStep(motion);
    internal::PairQuery(PairPlan{sideOfBoth, sideOfBoth, ofOne, startShare}, {motion, motion},
                        meter, scratch.of<internal::QueryMemory>())
        .run(asOne);

    const ChainMotion motionOfOne = one.motion(), motionOfOther = other.motion();
    StepContacts asTwo;
    internal::beginAnswer(asTwo);
    scratch.of<internal::QueryMemory>().beginStep(motionOfOne, motionOfOther);
    internal::PairQuery(PairPlan{sideOfOne, sideOfOther, ofTwo, startShare},
                        {motionOfOne, motionOfOther}, meter, scratch.of<internal::QueryMemory>())
        .run(asTwo);

    expectSame(asOne, asTwo, one.avatar.numLinks());
    for (const PairContact& contact : asTwo.pairs) {
      contacts += contact.verdict == Verdict::Contact ? 1 : 0;
      starts += contact.verdict == Verdict::StartsInContact ? 1 : 0;
    }
    left += asTwo.provenClearance < internal::kFloorShare * options.tolerance ? 1 : 0;
    inSlabs += internal::slabsOf(sideOfBoth.table, motion, options.tolerance) > 1 ? 1 : 0;
    if (HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(starts, 100);
  EXPECT_GT(left, 0);
  EXPECT_GT(inSlabs, 100);
}

}  // namespace
}  // namespace foretouch
