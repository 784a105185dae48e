// Which pairs of own links are asked, which are left out, and why.
#include "articulated/pair_rules.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/separation.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// A trunk with two arms of two links each, 40 cm apart, and a bare joint at each shoulder.
Avatar trunkWithArms() {
  RawSkeleton raw;
  raw.joints = {{"trunk", kNoParent, Vector3d::Zero()},
                {"left shoulder", 0, Vector3d(-0.2, 0.4, 0)},
                {"left arm", 1, Vector3d::Zero()},
                {"left hand", 2, Vector3d(-0.3, 0, 0)},
                {"right shoulder", 0, Vector3d(0.2, 0.4, 0)},
                {"right arm", 4, Vector3d::Zero()},
                {"right hand", 5, Vector3d(0.3, 0, 0)}};
  const Lss trunk{Vector3d::Zero(), Vector3d(0, 0.4, 0), 0.15};
  const Lss left{Vector3d::Zero(), Vector3d(-0.3, 0, 0), 0.06};
  const Lss right{Vector3d::Zero(), Vector3d(0.3, 0, 0), 0.06};
  const Lss hand{Vector3d::Zero(), Vector3d::Zero(), 0.07};
  return Avatar::build(Skeleton::build(raw).value(),
                       {{trunk}, {}, {left}, {hand}, {}, {right}, {hand}})
      .value();
}

/// Three balls; the last one overlaps the first at rest, and each moves the next.
Avatar ballsInOneAnother() {
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero()},
                {"b", 0, Vector3d(1, 0, 0)},
                {"c", 1, Vector3d(-0.92, 0, 0)}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.05};
  return Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}, {ball}}).value();
}

PairRules derived(const Avatar& avatar, const PairRuleOptions& options = {}) {
  return PairRules::derive(avatar, options).value();
}

TEST(PairRules, LeaveOutWhatOneMovesEvenPastABareJoint) {
  const Avatar avatar = trunkWithArms();
  const PairRules rules = derived(avatar);
  EXPECT_EQ(rules.reasonOf(0, 2), PairReason::Adjacent);
  EXPECT_EQ(rules.reasonOf(3, 2), PairReason::Adjacent) << "in either order";
  EXPECT_EQ(rules.reasonOf(0, 3), PairReason::Asked);
  EXPECT_EQ(rules.reasonOf(3, 6), PairReason::Asked);
  EXPECT_EQ(rules.numPairs(), 10);
  EXPECT_EQ(rules.numAsked(), 6);
  EXPECT_EQ(rules.leftOut().size(), 4U);
}

TEST(PairRules, LeaveOutWhatOverlapsAtRestOrShrinkIt) {
  const Avatar avatar = ballsInOneAnother();
  EXPECT_FALSE(PairRules::derive(avatar).ok()) << "nothing is left to ask";
  PairRuleOptions options;
  options.usePairRadii = true;
  options.restSkin = 0.01;
  const PairRules rules = derived(avatar, options);
  EXPECT_EQ(rules.reasonOf(0, 2), PairReason::Asked);
  ASSERT_EQ(rules.radii().size(), 1U);
  EXPECT_NEAR(rules.radii()[0].radius, 0.08 - 0.01, 1e-12);
  EXPECT_EQ(rules.radii()[0].a, 0);
  EXPECT_EQ(rules.radii()[0].b, 2);
}

// The rest pose of many files is none that a body takes: links may lie in one another there.
TEST(PairRules, AskWhatOverlapsAtRestAndInNoUsualPose) {
  const Avatar avatar = ballsInOneAnother();
  std::vector<Pose> poses(3, restPose(avatar.skeleton()));
  for (Pose& pose : poses) pose.translations[2] = Vector3d(0.5, 0, 0);
  PairRuleOptions options;
  options.usualPoses = &poses;
  EXPECT_EQ(derived(avatar, options).reasonOf(0, 2), PairReason::Asked);
  poses[1] = restPose(avatar.skeleton());
  EXPECT_FALSE(PairRules::derive(avatar, options).ok()) << "it is taken, so nothing is left to ask";
}

TEST(PairRules, LeaveOutWhatTouchesInNearlyAllUsualPoses) {
  const Avatar avatar = trunkWithArms();
  // The left hand on the trunk in three of four poses.
  std::vector<Pose> poses(4, restPose(avatar.skeleton()));
  for (std::size_t i = 0; i < 3; ++i) {
    poses[i].translations[3] = Vector3d(0.2, -0.2, 0);
  }
  PairRuleOptions options;
  options.usualPoses = &poses;
  options.alwaysShare = 0.75;
  EXPECT_EQ(derived(avatar, options).reasonOf(0, 3), PairReason::Always);
  options.alwaysShare = 0.8;
  EXPECT_EQ(derived(avatar, options).reasonOf(0, 3), PairReason::Asked);
}

TEST(PairRules, RefuseWhatTheyCannotMean) {
  const Avatar avatar = trunkWithArms();
  const auto errorOf = [&](const PairRuleOptions& options) {
    const auto rules = PairRules::derive(avatar, options);
    return rules.ok() ? std::string("accepted") : describe(rules.error());
  };
  PairRuleOptions options;
  options.leftOut = {{6, 3}};
  const PairRules rules = derived(avatar, options);
  EXPECT_EQ(rules.reasonOf(3, 6), PairReason::User);
  options.leftOut = {{3, 7}};
  EXPECT_NE(errorOf(options).find("expected a link of the avatar"), std::string::npos);
  options.leftOut = {{3, 3}};
  EXPECT_NE(errorOf(options).find("expected two different links"), std::string::npos);
  options.leftOut.clear();
  for (LinkId a = 0; a < 7; ++a) {
    for (LinkId b = 0; b < a; ++b) options.leftOut.push_back({a, b});
  }
  EXPECT_NE(errorOf(options).find("found all 10 left out"), std::string::npos);
  options = {};
  for (const double skin : {0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    options.restSkin = skin;
    EXPECT_NE(errorOf(options).find("restSkin"), std::string::npos) << skin;
  }
  options = {};
  options.alwaysShare = 0.0;
  EXPECT_NE(errorOf(options).find("alwaysShare"), std::string::npos);
  options = {};
  const std::vector<Pose> foreign(1);
  options.usualPoses = &foreign;
  EXPECT_NE(errorOf(options).find("usualPoses"), std::string::npos);
}

TEST(PairRules, KeepOneReasonPerPair) {
  const Avatar avatar = trunkWithArms();
  const PairRules rules =
      PairRules::leavingOut(avatar, {{6, 3, PairReason::User}, {3, 6, PairReason::Always}}).value();
  ASSERT_EQ(rules.leftOut().size(), 1U);
  EXPECT_EQ(rules.reasonOf(6, 3), PairReason::Always);
  EXPECT_EQ(rules.numAsked(), 9);
}

}  // namespace
}  // namespace foretouch
