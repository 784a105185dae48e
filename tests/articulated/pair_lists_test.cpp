// Exact lists of pairs and of radii, and reasons held against an avatar.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/pair_rules.h"

namespace foretouch {
namespace {

/// A trunk of 0.1 m radius, an arm left and right of it, each of upper and lower half, and a hat on
/// a joint without LSS. The upper arms overlap the trunk's neighbour, the hat, at rest.
Avatar figure() {
  RawSkeleton raw;
  const auto add = [&](const char* name, JointId parent, const Eigen::Vector3d& offset) {
    RawJoint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = offset;
    raw.joints.push_back(joint);
  };
  add("Trunk", kNoParent, {0, 0, 0});
  add("LeftArm", 0, {0.2, 0, 0});
  add("LeftHand", 1, {0.3, 0, 0});
  add("RightArm", 0, {-0.2, 0, 0});
  add("RightHand", 3, {-0.3, 0, 0});
  add("Neck", 0, {0, 0.2, 0});
  add("Hat", 5, {0, 0.1, 0});
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero(), half(0.15, 0, 0), brim(0.25, -0.25, 0);
  std::vector<std::vector<Lss>> lss{{{zero, zero, 0.1}},   {{zero, half, 0.05}},
                                    {{zero, half, 0.04}},  {{zero, -half, 0.05}},
                                    {{zero, -half, 0.04}}, {},
                                    {{zero, brim, 0.03}}};
  return Avatar::build(Skeleton::build(raw).value(), std::move(lss)).value();
}

constexpr LinkId kTrunk = 0, kLeftArm = 1, kLeftHand = 2, kRightArm = 3, kRightHand = 4, kHat = 6;

TEST(PairLists, ExactListsKeepTheirReasonsAndRadii) {
  const Avatar avatar = figure();
  const PairRules derived = PairRules::derive(avatar, {true, 2e-3, nullptr, 0.95, {}}).value();
  ASSERT_FALSE(derived.radii().empty());
  const PairRules same = PairRules::leavingOut(avatar, derived.leftOut(), derived.radii()).value();
  EXPECT_EQ(same.numAsked(), derived.numAsked());
  ASSERT_EQ(same.leftOut().size(), derived.leftOut().size());
  for (std::size_t i = 0; i < same.leftOut().size(); ++i) {
    EXPECT_EQ(same.leftOut()[i].reason, derived.leftOut()[i].reason);
  }
  ASSERT_EQ(same.radii().size(), derived.radii().size());
  for (std::size_t i = 0; i < same.radii().size(); ++i) {
    EXPECT_EQ(same.radii()[i].radius, derived.radii()[i].radius);
  }
}

void expectRefusal(const std::vector<PairRadius>& radii, std::int64_t index, const char* about) {
  const Avatar avatar = figure();
  const auto rules =
      PairRules::leavingOut(avatar, {{kTrunk, kLeftArm, PairReason::Adjacent}}, radii);
  ASSERT_FALSE(rules.ok()) << about;
  EXPECT_EQ(rules.error().file, "radii") << describe(rules.error());
  EXPECT_EQ(rules.error().index, index) << describe(rules.error());
  EXPECT_NE(rules.error().message.find(about), std::string::npos) << describe(rules.error());
}

TEST(PairLists, RefusesRadiiThatDoNotFit) {
  const PairRadius good{kLeftHand, 0, kRightHand, 0, 0.05};
  EXPECT_TRUE(PairRules::leavingOut(figure(), {}, {good}).ok());
  expectRefusal({good, {kLeftHand, 0, 99, 0, 0.05}}, 1, "links of the avatar");
  expectRefusal({{-1, 0, kLeftHand, 0, 0.05}}, 0, "links of the avatar");
  expectRefusal({{kLeftHand, 0, kLeftHand, 0, 0.05}}, 0, "two different links");
  expectRefusal({{kLeftHand, 1, kRightHand, 0, 0.05}}, 0, "LSS that the two links have");
  expectRefusal({{kLeftHand, 0, kRightHand, -1, 0.05}}, 0, "LSS that the two links have");
  expectRefusal({{kLeftHand, 0, kRightHand, 0, 0.08}}, 0, "below the sum");
  expectRefusal({{kLeftHand, 0, kRightHand, 0, 0.0}}, 0, "above 0");
  expectRefusal({good, {kTrunk, 0, kLeftArm, 0, 0.1}}, 1, "a pair of links that is asked");
  expectRefusal({good, {kRightHand, 0, kLeftHand, 0, 0.04}}, 1, "each two LSS once");
}

TEST(PairReasonCheck, HoldsReasonsAgainstTheAvatar) {
  const PairReasonCheck check(figure());
  EXPECT_TRUE(check.isTrue({kTrunk, kHat, PairReason::Adjacent}));
  EXPECT_FALSE(check.isTrue({kLeftArm, kRightArm, PairReason::Adjacent}));
  EXPECT_TRUE(check.isTrue({kLeftArm, kHat, PairReason::RestOverlap}));
  EXPECT_FALSE(check.isTrue({kLeftHand, kRightHand, PairReason::RestOverlap}));
  EXPECT_TRUE(check.isTrue({kLeftHand, kRightHand, PairReason::Always}));
  EXPECT_TRUE(check.isTrue({kLeftHand, kRightHand, PairReason::User}));
}

}  // namespace
}  // namespace foretouch
