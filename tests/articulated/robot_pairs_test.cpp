// A robot's configurations as poses, and which pairs of its links are asked. Expected values are
// closed forms.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "articulated/pair_rules.h"
#include "articulated/robot.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr LinkId kBase = 0, kArm = 1, kFold = 2, kCuff = 3;

RobotJoint turning(RobotJointKind kind, double lower, double upper) {
  RobotJoint joint;
  joint.kind = kind;
  joint.lower = lower;
  joint.upper = upper;
  return joint;
}

/// Flat, about z: a base of 1 m along x, a short arm up from its end, and from the arm's end a
/// foldable link, which lies back on the base at zero, outside its limits, and points away from it
/// within them. A ball around the fold's joint holds the arm's end, too.
Robot foldable() {
  RawSkeleton raw;
  raw.joints = {{"base", kNoParent, Vector3d::Zero()},
                {"arm", kBase, Vector3d(1, 0, 0)},
                {"fold", kArm, Vector3d(0, 0.3, 0)},
                {"cuff", kFold, Vector3d::Zero()}};
  const auto lss = [](const Vector3d& to, double radius) {
    return std::vector<Lss>{{Vector3d::Zero(), to, radius}};
  };
  Avatar avatar = Avatar::build(Skeleton::build(raw).value(),
                                {lss({1, 0, 0}, 0.05), lss({0, 0.3, 0}, 0.05),
                                 lss({-0.5, -0.25, 0}, 0.05), lss(Vector3d::Zero(), 0.2)})
                      .value();
  return Robot::build(std::move(avatar),
                      {RobotJoint(), turning(RobotJointKind::Revolute, -0.1, 0.1),
                       turning(RobotJointKind::Revolute, 2.0, 4.0),
                       turning(RobotJointKind::Continuous, 0, 0)})
      .value();
}

TEST(Robot, NamesTheLimitThatAConfigurationBreaks) {
  const Robot robot = foldable();  // coordinates: of the arm, the fold and the cuff
  const std::array<double, 3> within{0.1, 2.0, 50.0};
  EXPECT_FALSE(robot.breachOf(within.data()).isAny());
  const std::array<double, 3> low{0.0, 1.5, 0.0};
  const LimitBreach breach = robot.breachOf(low.data());
  EXPECT_EQ(breach.coordinate, 1);
  EXPECT_EQ(breach.joint, kFold);
  EXPECT_EQ(breach.value, 1.5);
  EXPECT_EQ(breach.lower, 2.0);
  EXPECT_EQ(breach.upper, 4.0);
  const std::array<double, 3> high{0.2, 5.0, 0.0};
  EXPECT_EQ(robot.breachOf(high.data()).joint, kArm) << "the first of two";
}

TEST(RobotPairRules, LookAtConfigurationsWithinTheLimitsAndNotAtZero) {
  const Robot robot = foldable();
  const PairRules rules = PairRules::derive(robot).value();
  EXPECT_EQ(rules.numUsualPoses(), 10000);
  EXPECT_EQ(rules.numPairs(), 6);
  EXPECT_EQ(rules.numAsked(), 2);
  EXPECT_EQ(rules.reasonOf(kArm, kCuff), PairReason::Always);
  EXPECT_EQ(rules.reasonOf(kBase, kArm), PairReason::Adjacent);
  EXPECT_EQ(rules.reasonOf(kBase, kFold), PairReason::Asked) << "though they touch at zero";
  EXPECT_EQ(rules.reasonOf(kBase, kCuff), PairReason::Asked) << "though no sample touches";
  ASSERT_EQ(rules.touches().size(), 6u);
  for (const PairTouches& pair : rules.touches()) {
    const bool never = pair.a == kBase && pair.b != kArm;
    EXPECT_EQ(pair.touches, never ? 0 : 10000) << pair.a << " " << pair.b;
  }
  // What the rest pose alone says of the same avatar.
  EXPECT_EQ(PairRules::derive(robot.avatar()).value().reasonOf(kBase, kFold),
            PairReason::RestOverlap);
}

TEST(RobotPairRules, AreTheSameForASeedAndLeaveOutWhatTheUserSays) {
  const Robot robot = foldable();
  RobotPairOptions options;
  options.samples = 50;
  options.leftOut = {{kCuff, kBase}};
  const PairRules rules = PairRules::derive(robot, options).value();
  EXPECT_EQ(rules.reasonOf(kBase, kCuff), PairReason::User);
  EXPECT_EQ(rules.numUsualPoses(), 50);
  options.samples = 0;
  EXPECT_EQ(PairRules::derive(robot, options).error().file, "samples");
}

TEST(SampledPoses, FillTheLimitsEvenlyAndAreTheSameForASeed) {
  const Robot robot = foldable();
  const auto poses = robot.sampledPoses(4000, 7).value();
  double least = 10.0, most = -10.0, sum = 0.0;
  for (const Pose& pose : poses) {
    const Quaternion& turn = pose.rotations[kFold];
    const double angle = 2.0 * std::atan2(turn.z(), turn.w());
    least = std::min(least, angle);
    most = std::max(most, angle);
    sum += angle;
  }
  EXPECT_GE(least, 2.0 - 1e-12);
  EXPECT_LE(most, 4.0 + 1e-12);
  EXPECT_LT(least, 2.01);
  EXPECT_GT(most, 3.99);
  EXPECT_NEAR(sum / 4000, 3.0, 5.0 * 2.0 / std::sqrt(12.0 * 4000.0));  // five standard errors
  const auto again = robot.sampledPoses(4000, 7).value(), other = robot.sampledPoses(1, 8).value();
  EXPECT_EQ(again.back().rotations[kFold].coeffs(), poses.back().rotations[kFold].coeffs());
  EXPECT_NE(other[0].rotations[kFold].coeffs(), poses[0].rotations[kFold].coeffs());
}

/// Two joints of these kinds, a metre apart, and a ball a metre beyond the second.
Robot twoJoints(RobotJointKind first, RobotJointKind second) {
  RawSkeleton raw;
  raw.joints = {{"first", kNoParent, Vector3d::Zero()}, {"second", 0, Vector3d(1, 0, 0)}};
  Avatar avatar = Avatar::build(Skeleton::build(raw).value(),
                                {{}, {{Vector3d(1, 0, 0), Vector3d(1, 0, 0), 0.1}}})
                      .value();
  RobotJoint of = turning(first, -1, 1), then = turning(second, -1, 1);
  of.axis = then.axis = Vector3d(0, 0, 2);
  return Robot::build(std::move(avatar), {of, then}).value();
}

/// The least and the largest of 2000 samples of a shift with these limits.
std::pair<double, double> rangeOfShifts(double lower, double upper) {
  const Robot of = twoJoints(RobotJointKind::Fixed, RobotJointKind::Prismatic);
  std::vector<RobotJoint> joints = of.joints();
  joints[1].lower = lower;
  joints[1].upper = upper;
  double least = 1e9, most = -1e9;
  const Robot robot = Robot::build(of.avatar(), joints).value();
  const std::vector<Pose> poses = robot.sampledPoses(2000, 3).value();
  for (const Pose& pose : poses) {
    least = std::min(least, pose.translations[1].z());
    most = std::max(most, pose.translations[1].z());
  }
  return {least, most};
}

TEST(SampledPoses, FillAHalfTurnOrAMetreWhereALimitIsMissing) {
  constexpr double kNone = RobotJoint::kUnlimited;
  const auto expectRange = [](double lower, double upper, double least, double most) {
    const auto [from, to] = rangeOfShifts(lower, upper);
    EXPECT_GE(from, least);
    EXPECT_LT(from, least + 0.01);
    EXPECT_LE(to, most);
    EXPECT_GT(to, most - 0.01);
  };
  expectRange(-kNone, kNone, -1.0, 1.0);
  expectRange(5.0, kNone, 5.0, 6.0);
  expectRange(-kNone, -5.0, -6.0, -5.0);
  expectRange(-kNone, 0.5, -1.0, 0.5);
  double least = 0.0, most = 0.0;
  const std::vector<Pose> poses = foldable().sampledPoses(2000, 3).value();
  for (const Pose& pose : poses) {
    const Quaternion& turn = pose.rotations[kCuff];
    const double angle = 2.0 * std::atan2(turn.z(), turn.w());
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  EXPECT_LT(least, 0.01 - kPi);
  EXPECT_GT(most, kPi - 0.01);
}

TEST(SampledPoses, KeepTheLimitsOfJointsThatFollow) {
  const Robot of = foldable();
  std::vector<RobotJoint> joints = of.joints();
  joints[kFold].mimicOf = kArm;
  joints[kFold].mimicOffset = 2.0;  // within [2, 4] for the half of the leader's range
  const Robot robot = Robot::build(of.avatar(), joints).value();
  const auto poses = robot.sampledPoses(100, 1).value();
  for (const Pose& pose : poses) EXPECT_GE(pose.rotations[kArm].z(), 0.0);
  joints[kFold].mimicOffset = 9.0;
  EXPECT_EQ(Robot::build(of.avatar(), joints).value().sampledPoses(3, 1).error().file, "samples");
}

TEST(PathAlong, TurnsEveryJointTheWayThatItsNumberSays) {
  const Robot robot = foldable();
  const std::vector<double> q = {0.0, 2.0, -2.0, 0.1, 3.0, 2.0, 0.1, 3.0, 100.0};
  const RobotPath path = robot.pathAlong(q.data(), 3).value();
  ASSERT_EQ(path.poses.size(), 2u + 64u + 1u);  // 4 rad in two parts, 98 in 64
  ASSERT_EQ(path.at.size(), path.poses.size());
  EXPECT_EQ(path.at[1], 0.5);
  EXPECT_EQ(path.at[2], 1.0);
  EXPECT_EQ(path.at.back(), 2.0);
  const Skeleton& skeleton = robot.avatar().skeleton();
  for (std::size_t i = 0; i + 1 < path.poses.size(); ++i) {
    // Halfway along the shorter arc, the joint is at the mean of its two numbers.
    const ChainMotion motion(skeleton, path.poses[i], path.poses[i + 1]);
    Pose half;
    motion.poseAt(0.5, half);
    const double at = 0.5 * (path.at[i] + path.at[i + 1]);
    const double angle = at < 1.0 ? -2.0 + 4.0 * at : 2.0 + 98.0 * (at - 1.0);
    const Quaternion& turn = half.rotations[kCuff];
    const double sign = turn.w() * std::cos(angle / 2) + turn.z() * std::sin(angle / 2);
    EXPECT_NEAR(std::abs(sign), 1.0, 1e-12) << at;
  }
  EXPECT_FALSE(robot.pathAlong(q.data(), 0).ok());
  const std::vector<double> bad = {0.0, 2.0, 0.0, 0.0, 2.0, 2000.0};
  EXPECT_EQ(robot.pathAlong(bad.data(), 2).error().index, 2);
}

/// A mobile base whose rest frame stands a quarter turn about x: its plane is x and z of W.
Robot mobileBase() {
  RawSkeleton raw;
  raw.joints = {{"base", kNoParent, Vector3d(0, 0, 0.5),
                 Quaternion(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX()))},
                {"arm", kBase, Vector3d(0.4, 0, 0)}};
  const std::vector<Lss> ball{{Vector3d::Zero(), Vector3d::Zero(), 0.1}};
  Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {ball, ball}).value();
  RobotJoint base;
  base.kind = RobotJointKind::Planar;
  return Robot::build(std::move(avatar), {base, turning(RobotJointKind::Continuous, 0, 0)}).value();
}

TEST(MobileBase, StandsAndMovesWhereItsNumbersSay) {
  const Robot robot = mobileBase();
  ASSERT_EQ(robot.numCoordinates(), 4u);
  const std::array<double, 4> q{0.3, 0.7, 0.5 * kPi, 0.0};
  Pose pose;
  robot.poseAt(q.data(), pose);
  const ChainMotion still(robot.avatar().skeleton(), pose, pose);
  std::vector<LinkState> states;
  still.statesAt(0.0, states);
  EXPECT_LT((states[kBase].p_WL - Vector3d(0.3, 0, 1.2)).norm(), 1e-15);
  // A quarter turn takes the arm from along the plane's x to along its y.
  EXPECT_LT((states[kArm].p_WL - Vector3d(0.3, 0, 1.6)).norm(), 1e-15);
  std::array<double, 4> slope{};
  const Vector3d tip = states[kArm].p_WL + 0.2 * Vector3d::UnitZ(), along(2, 3, 5);
  robot.slopeAt(q.data(), states, kArm, tip, along, slope.data());
  EXPECT_NEAR(slope[0], 2.0, 1e-14);
  EXPECT_NEAR(slope[1], 5.0, 1e-14);
  EXPECT_NEAR(slope[2], -0.6 * 2.0, 1e-14);
  EXPECT_NEAR(slope[3], -0.2 * 2.0, 1e-14);
}

TEST(MobileBase, TurnsAsFarAsItsAngleAndNotAsItsShiftsSay) {
  const Robot robot = mobileBase();
  const std::vector<double> q = {0.0, 0.0, 1.0, 0.0, 100.0, -50.0, 9.0, 2.0};
  EXPECT_EQ(robot.largestTurn(q.data(), q.data() + 4), 8.0);
  EXPECT_EQ(robot.largestTurn(q.data() + 4, q.data()), 8.0);
  EXPECT_EQ(robot.partsBetween(q.data(), q.data() + 4, 4), 4);
  EXPECT_EQ(robot.partsBetween(q.data(), q.data() + 4, 2), 0);
  EXPECT_EQ(robot.pathAlong(q.data(), 2).value().poses.size(), 5u);
}

TEST(Robot, AxesHaveALengthOfOneWhateverTheyWereGivenAs) {
  const auto axisOf = [](RobotJointKind first, RobotJointKind second, std::size_t joint) {
    return twoJoints(first, second).joints()[joint].axis;
  };
  constexpr auto kTurns = RobotJointKind::Revolute, kStays = RobotJointKind::Fixed;
  EXPECT_EQ(axisOf(kTurns, kStays, 0), Vector3d::UnitZ());
  EXPECT_EQ(axisOf(kStays, kTurns, 1), Vector3d::UnitZ());
  EXPECT_EQ(axisOf(kTurns, RobotJointKind::Prismatic, 1), Vector3d::UnitZ());
}

// robot.md 2: of one joint that turns by up to 1000 rad, 1.4 (64 u + 7 u 1000) times the reach.
TEST(Robot, RoundingOfPosesIsThatOfTheJointsThatMove) {
  constexpr auto kTurns = RobotJointKind::Continuous, kStays = RobotJointKind::Fixed;
  constexpr double kOneJoint = 1.4 * (64 + 7 * 1000) * 0x1p-53, kReach = 2.0;
  EXPECT_EQ(twoJoints(kStays, kStays).poseRounding(), 0.0);
  EXPECT_EQ(twoJoints(kStays, kStays).reach(), kReach);
  EXPECT_EQ(twoJoints(kTurns, RobotJointKind::Revolute).reach(), kReach);
  EXPECT_EQ(twoJoints(RobotJointKind::Prismatic, kTurns).reach(), kReach + 1.0) << "to its limit";
  for (const auto& [first, second] : {std::pair{kTurns, kStays}, std::pair{kStays, kTurns}}) {
    const double rounding = twoJoints(first, second).poseRounding();
    EXPECT_GE(rounding, kOneJoint * kReach);
    EXPECT_LE(rounding, 4.0 * kOneJoint * kReach);
    EXPECT_EQ(twoJoints(kTurns, kTurns).poseRounding(), 2.0 * rounding);
  }
  // One that follows turns by as much more as its factor says.
  std::vector<RobotJoint> joints = twoJoints(kTurns, kTurns).joints();
  joints[1].mimicOf = 0;
  joints[1].mimicFactor = -5.0;
  joints[1].mimicOffset = 500.0;
  const Robot following = Robot::build(twoJoints(kTurns, kTurns).avatar(), joints).value();
  EXPECT_GE(following.poseRounding(), 1.4 * (2 * 64 + 7 * (1000 + 5500)) * 0x1p-53 * kReach);
}

TEST(PairRulesAsking, AskOnlyWhatIsListedAndRefuseWhatMakesNoSense) {
  const Avatar avatar = foldable().avatar();
  const PairRules rules = PairRules::asking(avatar, {{kCuff, kBase}, {kBase, kCuff}}).value();
  EXPECT_EQ(rules.numAsked(), 1);
  EXPECT_EQ(rules.reasonOf(kBase, kCuff), PairReason::Asked);
  EXPECT_EQ(rules.reasonOf(kBase, kFold), PairReason::User);
  const PairRules adjacent = PairRules::asking(avatar, {{kBase, kArm}}).value();
  EXPECT_EQ(adjacent.reasonOf(kBase, kArm), PairReason::Asked);
  // Its mirror image.
  const PairRules others = PairRules::leavingOut(avatar, {{kBase, kCuff}}).value();
  EXPECT_EQ(others.numAsked(), 5);
  EXPECT_EQ(others.reasonOf(kBase, kCuff), PairReason::User);
  EXPECT_EQ(PairRules::asking(avatar, {}).error().code, ErrorCode::Empty);
  EXPECT_EQ(PairRules::asking(avatar, {{0, 0}}).error().index, 0);
  EXPECT_EQ(PairRules::asking(avatar, {{0, 4}}).error().index, 4);
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero()}, {"bare", 0, Vector3d::Zero()}};
  const Avatar bare =
      Avatar::build(Skeleton::build(raw).value(), {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}}, {}})
          .value();
  EXPECT_EQ(PairRules::asking(bare, {{0, 1}}).error().index, 1);
}

}  // namespace
}  // namespace foretouch
