#include "articulated/motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
constexpr double kPi = 3.14159265358979323846;

Quaternion about(const Vector3d& axis, double angle) {
  return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// A root at the origin and a child one metre along x.
struct Arm {
  Skeleton skeleton;
  Pose from, to;
  Arm() {
    RawSkeleton raw;
    raw.joints.push_back({"root", kNoParent, Vector3d::Zero(), Quaternion::Identity()});
    raw.joints.push_back({"child", 0, Vector3d::UnitX(), Quaternion::Identity()});
    skeleton = Skeleton::build(raw).value();
    from = to = restPose(skeleton);
  }
  [[nodiscard]] ChainMotion motion() const { return ChainMotion(skeleton, from, to); }
};

TEST(ChainMotion, JointTurnsAtConstantRateAboutAFixedAxis) {
  Arm arm;
  arm.to.rotations[0] = about(Vector3d::UnitZ(), 1.2);
  const ChainMotion motion = arm.motion();
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const LinkState state = motion.stateAt(1, t);
    EXPECT_NEAR((state.p_WL - Vector3d(std::cos(1.2 * t), std::sin(1.2 * t), 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((state.v_WL - 1.2 * Vector3d(-std::sin(1.2 * t), std::cos(1.2 * t), 0)).norm(), 0,
                1e-14);
    EXPECT_NEAR((state.w_WL - Vector3d(0, 0, 1.2)).norm(), 0, 1e-14);
  }
}

TEST(ChainMotion, RotationsComposeDownTheChain) {
  Arm arm;
  arm.to.rotations[0] = about(Vector3d::UnitZ(), kPi / 2);
  arm.to.rotations[1] = about(Vector3d::UnitZ(), kPi / 2);
  const LinkState state = arm.motion().stateAt(1, 1.0);
  EXPECT_NEAR((state.pointAt(Vector3d::UnitX()) - Vector3d(-1, 1, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((state.w_WL - Vector3d(0, 0, kPi)).norm(), 0, 1e-14);
}

TEST(ChainMotion, TranslationsAreLinearInTheParentsFrame) {
  Arm arm;
  arm.from.rotations[0] = arm.to.rotations[0] = about(Vector3d::UnitZ(), kPi / 2);
  arm.to.translations[1] = Vector3d(3, 0, 0);
  const LinkState state = arm.motion().stateAt(1, 0.5);
  EXPECT_NEAR((state.p_WL - Vector3d(0, 2, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR((state.v_WL - Vector3d(0, 2, 0)).norm(), 0, 1e-15);
}

TEST(ChainMotion, BothSignsOfAQuaternionAreTheSameRotation) {
  Arm arm;
  arm.to.rotations[0] = about(Vector3d::UnitZ(), 1.0);
  const Vector3d expected = arm.motion().stateAt(1, 0.3).p_WL;
  arm.to.rotations[0].coeffs() = -arm.to.rotations[0].coeffs();
  EXPECT_EQ(arm.motion().stateAt(1, 0.3).p_WL, expected);
}

TEST(ChainMotion, TakesTheShorterArc) {
  Arm arm;
  arm.to.rotations[0] = about(Vector3d::UnitZ(), 1.5 * kPi);
  EXPECT_NEAR((arm.motion().stateAt(1, 0.5).p_WL - Vector3d(1, -1, 0).normalized()).norm(), 0,
              1e-15);
}

TEST(ChainMotion, HalfTurnIsHalfATurnEitherWay) {
  Arm arm;
  arm.to.rotations[0] = Quaternion(0, 0, 0, 1);
  const ChainMotion motion = arm.motion();
  EXPECT_NEAR(std::abs(motion.stateAt(1, 0.5).p_WL.y()), 1.0, 1e-15);
  EXPECT_NEAR((motion.stateAt(1, 1.0).p_WL - Vector3d(-1, 0, 0)).norm(), 0, 1e-15);
}

TEST(ChainMotion, NoMotionStaysWhereItIs) {
  Arm arm;
  arm.from.rotations[0] = arm.to.rotations[0] = about(Vector3d(1, 2, 3), 0.7);
  const ChainMotion motion = arm.motion();
  EXPECT_EQ(motion.stateAt(1, 0.0).p_WL, motion.stateAt(1, 1.0).p_WL);
  EXPECT_LT(motion.bounds(1).speed, 1e-12);
  EXPECT_LT(motion.bounds(1).acceleration, 1e-12);
}

// A pose on the way divides the motion: both parts run along the whole one, 10 km away too.
TEST(ChainMotion, APoseOnTheWayDividesItsPath) {
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const test::RandomMotion steps = test::randomMotion(random, 6);
    const ChainMotion whole(steps.skeleton, steps.from, steps.to);
    const double cut = random.uniform(0.0, 1.0);
    Pose at;
    whole.poseAt(cut, at);
    ASSERT_TRUE(validatedPose(steps.skeleton, at).ok());
    const ChainMotion first(steps.skeleton, steps.from, at), second(steps.skeleton, at, steps.to);
    const double reach = 1.0 + whole.bounds(0).reach;
    for (const double s : {0.0, 0.3, 1.0}) {
      for (LinkId link = 0; link < whole.numLinks(); ++link) {
        const LinkState one = whole.stateAt(link, s * cut), other = first.stateAt(link, s);
        EXPECT_LT((one.p_WL - other.p_WL).norm(), 1e-13 * reach);
        EXPECT_LT((one.R_WL - other.R_WL).norm(), 1e-13);
        const LinkState later = whole.stateAt(link, cut + s * (1.0 - cut));
        const LinkState last = second.stateAt(link, s);
        EXPECT_LT((later.p_WL - last.p_WL).norm(), 1e-13 * reach);
        EXPECT_LT((later.R_WL - last.R_WL).norm(), 1e-13);
      }
    }
  }
}

// What somebody sees who rides on a link above: the frames of W, turned into his, and bounds that
// are never larger than those in W and hold.
TEST(ChainMotion, StatesInALinksFrameAreThoseOfTheWorldSeenFromIt) {
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const test::RandomMotion steps = test::randomMotion(random, 8);
    const ChainMotion motion(steps.skeleton, steps.from, steps.to);
    MotionEvaluator evaluator(motion);
    for (LinkId link = 0; link < 8; ++link) {
      for (LinkId frame = link; frame != kNoParent; frame = motion.parent(frame)) {
        const MotionBounds bounds = motion.sumsIn(frame, link).bounds();
        const MotionBounds inWorld = motion.bounds(link);
        EXPECT_LE(bounds.angularSpeed, inWorld.angularSpeed);
        EXPECT_LE(bounds.acceleration, inWorld.acceleration);
        EXPECT_LE(bounds.speed, inWorld.speed);
        EXPECT_LE(bounds.eighthDerivative, inWorld.eighthDerivative);
        for (const double t : {0.0, 0.37, 1.0}) {
          const LinkState seen = evaluator.stateIn(frame, link, t);
          const LinkState above = motion.stateAt(frame, t), below = motion.stateAt(link, t);
          const Vector3d p = above.R_WL.transpose() * (below.p_WL - above.p_WL);
          const double rounding = 1e-13 * (1.0 + inWorld.reach);
          EXPECT_LT((seen.p_WL - p).norm(), rounding);
          EXPECT_LT((seen.R_WL - above.R_WL.transpose() * below.R_WL).norm(), 1e-13);
          EXPECT_LE(seen.v_WL.norm(), bounds.speed * (1.0 + 1e-12) + 1e-15);
          EXPECT_LE(seen.w_WL.norm(), bounds.angularSpeed * (1.0 + 1e-12) + 1e-15);
        }
      }
    }
  }
}

}  // namespace
}  // namespace foretouch
