// The cubic between poses: what it meets, how smooth it is, and that no point of a piece strays
// from it by more than is said.
#include "articulated/motion_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/index.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using test::Random;

/// Four poses of a random chain that turns smoothly.
struct FourPoses {
  Skeleton skeleton;
  Pose poses[4];
  [[nodiscard]] PosedStep step(double before, double at, double after) const {
    return {&poses[0], &poses[1], &poses[2], &poses[3], before, at, after};
  }
};

FourPoses fourPoses(Random& random, double turn) {
  test::RandomMotion motion = test::randomMotion(random, 4);
  FourPoses four{motion.skeleton, {motion.from, motion.from, motion.from, motion.from}};
  for (int k = 1; k < 4; ++k) {
    for (std::size_t joint = 0; joint < four.poses[k].rotations.size(); ++joint) {
      four.poses[k].rotations[joint] =
          (four.poses[k - 1].rotations[joint] * random.turn(random.uniform(0.0, turn)))
              .normalized();
      four.poses[k].translations[joint] = four.poses[k - 1].translations[joint] + random.inBox(0.1);
    }
  }
  return four;
}

double turnBetween(const Quaternion& a, const Quaternion& b) {
  return 4.0 * std::asin(std::min(1.0, 0.5 * std::min((a.coeffs() - b.coeffs()).norm(),
                                                      (a.coeffs() + b.coeffs()).norm())));
}

TEST(MotionModel, MeetsTheGivenPosesBitForBit) {
  Random random(1);
  const FourPoses four = fourPoses(random, 0.5);
  ModelMotion motion;
  motion.assign(four.skeleton, four.step(0.1, 0.1, 0.1), MotionModel::CubicLate);
  Pose pose;
  motion.poseAt(0.0, pose);
  EXPECT_EQ(pose.rotations[1].coeffs(), four.poses[1].rotations[1].coeffs());
  motion.poseAt(1.0, pose);
  EXPECT_EQ(pose.translations[0], four.poses[2].translations[0]);
}

/// The rate before and after a pose, by differences: where joints turn far in a step, and where
/// they turn so little that series take over.
class SmoothMotionModel : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Turns, SmoothMotionModel, testing::Values(0.4, 0.09));

TEST_P(SmoothMotionModel, IsSmoothAcrossPosesWhateverTheirTimes) {
  Random random(2);
  RawSkeleton raw;
  raw.joints = {{"one", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  Pose poses[5];
  for (int k = 0; k < 5; ++k) {
    poses[k] = restPose(skeleton);
    if (k > 0) {
      poses[k].rotations[0] = (poses[k - 1].rotations[0] * random.turn(GetParam())).normalized();
      poses[k].translations[0] = poses[k - 1].translations[0] + random.inBox(0.1);
    }
  }
  const double seconds[4] = {0.1, 0.07, 0.13, 0.1};
  ModelMotion before, after;
  before.assign(skeleton,
                {&poses[0], &poses[1], &poses[2], &poses[3], seconds[0], seconds[1], seconds[2]},
                MotionModel::CubicLate);
  after.assign(skeleton,
               {&poses[1], &poses[2], &poses[3], &poses[4], seconds[1], seconds[2], seconds[3]},
               MotionModel::CubicLate);
  constexpr double kDt = 1e-8, kTolerance = 2e-5;
  Pose early, late;
  before.poseAt(1.0 - kDt / seconds[1], early);
  after.poseAt(kDt / seconds[2], late);
  const Quaternion& at = poses[2].rotations[0];
  const Eigen::Vector3d rateBefore = 2.0 / kDt * (early.rotations[0].conjugate() * at).vec();
  const Eigen::Vector3d rateAfter = 2.0 / kDt * (at.conjugate() * late.rotations[0]).vec();
  EXPECT_LT((rateBefore - rateAfter).norm(), kTolerance * rateAfter.norm());
  const Eigen::Vector3d speedBefore = (poses[2].translations[0] - early.translations[0]) / kDt;
  const Eigen::Vector3d speedAfter = (late.translations[0] - poses[2].translations[0]) / kDt;
  EXPECT_LT((speedBefore - speedAfter).norm(), kTolerance * speedAfter.norm());
}

// Poses of a constant rate lie on the curve, whatever the turn: where series are used, just beyond,
// and near the largest.
TEST(MotionModel, TurnsAtTheRateOfPosesThatDo) {
  RawSkeleton raw;
  raw.joints = {{"one", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Eigen::Vector3d axis = Eigen::Vector3d(2, -3, 6) / 7.0;
  const auto turned = [&](double angle) { return Quaternion(Eigen::AngleAxisd(angle, axis)); };
  for (const double angle : {1e-4, 0.05, 0.19, 0.199, 0.201, 0.6, 1.9}) {
    SCOPED_TRACE(angle);
    Pose poses[4];
    for (int k = 0; k < 4; ++k) {
      poses[k] = restPose(skeleton);
      poses[k].rotations[0] = turned((k - 1) * angle);
    }
    ModelMotion motion;
    motion.assign(skeleton, {&poses[0], &poses[1], &poses[2], &poses[3], 0.1, 0.1, 0.1},
                  MotionModel::CubicLate);
    for (const double t : {0.1, 0.5, 0.99}) {
      Pose pose;
      motion.poseAt(t, pose);
      EXPECT_LE(turnBetween(pose.rotations[0], turned(t * angle)), 3e-15);
    }
  }
}

TEST(MotionModel, NoJointOfAPieceStraysFartherThanSaid) {
  Random random(3);
  double tightest = 0.0;
  int told = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const FourPoses four = fourPoses(random, random.uniform(0.01, 1.5));
    ModelMotion model;
    const MotionModel kind = trial % 2 == 0 ? MotionModel::CubicLate : MotionModel::Cubic;
    model.assign(four.skeleton, four.step(0.1, random.uniform(0.05, 0.2), 0.1), kind);
    const int pieces = 1 << random.below(5);
    const int k = random.below(pieces);
    const double begin = static_cast<double>(k) / pieces, end = static_cast<double>(k + 1) / pieces;
    Pose first, last, at;
    model.poseAt(begin, first);
    model.poseAt(end, last);
    for (std::size_t joint = 0; joint < first.rotations.size(); ++joint) {
      const JointStray stray = model.strayOf(static_cast<JointId>(joint), begin, end);
      if (!std::isfinite(stray.turn)) continue;
      ++told;
      for (int i = 1; i < 16; ++i) {
        const double s = i / 16.0;
        model.poseAt(begin + s * (end - begin), at);
        // Below 4 s (1 - s) of the most, which bracket.md 3 builds on.
        const double share = 4.0 * s * (1.0 - s);
        const double turn = turnBetween(first.rotations[joint].slerp(s, last.rotations[joint]),
                                        at.rotations[joint]);
        EXPECT_LE(turn, share * stray.turn + 1e-12);
        const Eigen::Vector3d line =
            (1 - s) * first.translations[joint] + s * last.translations[joint];
        EXPECT_LE((line - at.translations[joint]).norm(), share * stray.shift + 1e-11);
        if (stray.turn > 1e-6) tightest = std::max(tightest, turn / stray.turn);
      }
    }
  }
  EXPECT_GT(told, 300);
  EXPECT_GT(tightest, 0.5);
}

TEST(MotionModel, GoesOnAsItWent) {
  Random random(4);
  const FourPoses four = fourPoses(random, 0.3);
  std::vector<Pose> ends;
  std::vector<double> seconds;
  ASSERT_TRUE(ModelMotion::goOn(four.step(0.1, 0.1, 0.1), 0.1, 32, seconds, ends));
  ASSERT_EQ(ends.size(), seconds.size());
  EXPECT_EQ(seconds.back(), 0.1);
  const Quaternion turn = four.poses[1].rotations[2].conjugate() * four.poses[2].rotations[2];
  EXPECT_LT(turnBetween(ends.back().rotations[2], four.poses[2].rotations[2] * turn), 1e-7);
  ASSERT_FALSE(ModelMotion::goOn(four.step(0.1, 0.1, 0.1), 1e6, 32, seconds, ends));
}

TEST(MotionModel, GoesOnInPiecesThatDoubleUntilAJointTurnsTooFar) {
  Random random(5);
  const FourPoses four = fourPoses(random, 0.3);
  std::vector<Pose> ends;
  std::vector<double> seconds;
  constexpr double kHorizonS = 1.0;
  ASSERT_TRUE(ModelMotion::goOn(four.step(0.1, 0.1, 0.1), kHorizonS, 32, seconds, ends));
  double before = 0.0;
  const Pose* last = &four.poses[2];
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (k > 0) {
      EXPECT_LE(seconds[k] - before, before * (1.0 + 1e-12));
    }
    for (std::size_t joint = 0; joint < ends[k].rotations.size(); ++joint) {
      EXPECT_LE(turnBetween(ends[k].rotations[joint], last->rotations[joint]), 1.0 + 1e-9);
    }
    before = seconds[k];
    last = &ends[k];
  }
  EXPECT_EQ(before, kHorizonS);
  // However slow it is: what comes soon is asked in short pieces.
  ASSERT_TRUE(
      ModelMotion::goOn(fourPoses(random, 1e-6).step(0.1, 0.1, 0.1), kHorizonS, 32, seconds, ends));
  EXPECT_EQ(seconds.front(), kHorizonS / 32.0);
  EXPECT_EQ(seconds.size(), 6u);
}

}  // namespace
}  // namespace foretouch
