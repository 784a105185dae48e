#include "middleware/solid/joint_ranges.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "bench/solid/figure.h"
#include "middleware/solid/tree_pose.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Root, and one joint on it.
struct Elbow {
  Elbow() : avatar(tools::figure()), skeleton(avatar.skeleton()), ranges(skeleton) {
    joint = static_cast<std::size_t>(*skeleton.find("RightForeArm"));
    isLost.assign(countOf(skeleton.numJoints()), 0);
  }
  [[nodiscard]] Pose turned(double angle, const Vector3d& axis) const {
    Pose pose = restPose(skeleton);
    pose.rotations[joint] = Quaternion(Eigen::AngleAxisd(angle, axis));
    return pose;
  }
  void see(const Pose& pose) { ranges.learn(pose, isLost); }
  [[nodiscard]] std::vector<LinkState> placed(const Pose& pose) const {
    std::vector<LinkState> states;
    placeLinks(skeleton, pose, states);
    return states;
  }
  /// Rows of this joint at a pose, whichever are within `reach`.
  [[nodiscard]] std::vector<ContactRow> rowsAt(const Pose& pose, double reach) const {
    std::vector<ContactRow> all, own;
    ranges.append(placed(pose), reach, all);
    for (const ContactRow& row : all) {
      if (slotOf(row.link) == joint) own.push_back(row);
    }
    return own;
  }

  Avatar avatar;
  Skeleton skeleton;
  JointRanges ranges;
  std::vector<std::uint8_t> isLost;
  std::size_t joint = 0;
};

TEST(JointRanges, HaveNoEndBeforeAnythingWasSeen) {
  const Elbow elbow;
  EXPECT_TRUE(elbow.rowsAt(elbow.turned(3.0, Vector3d::UnitX()), 1e3).empty());
}

TEST(JointRanges, EndAMarginBeyondWhatWasSeen) {
  Elbow elbow;
  elbow.see(elbow.turned(0.0, Vector3d::UnitY()));
  elbow.see(elbow.turned(1.2, Vector3d::UnitY()));
  elbow.see(elbow.turned(0.4, Vector3d::UnitY()));
  const auto isWithin = [&](double angle) {
    const auto rows = elbow.rowsAt(elbow.turned(angle, Vector3d::UnitY()), 1e3);
    EXPECT_EQ(rows.size(), 6u);
    return std::all_of(rows.begin(), rows.end(),
                       [](const ContactRow& row) { return row.gap >= -1e-12; });
  };
  EXPECT_TRUE(isWithin(1.2 + JointRanges::kMargin - 1e-6));
  EXPECT_FALSE(isWithin(1.2 + JointRanges::kMargin + 1e-6));
  EXPECT_TRUE(isWithin(-JointRanges::kMargin + 1e-6));
  EXPECT_FALSE(isWithin(-JointRanges::kMargin - 1e-6));
}

TEST(JointRanges, ArePastNoTurnThatWasSeen) {
  test::Random random(3);
  Elbow elbow;
  std::vector<Pose> seen;
  for (int i = 0; i < 200; ++i) {
    Pose pose = restPose(elbow.skeleton);
    for (Quaternion& q : pose.rotations) q = random.turn(random.uniform(0.0, 3.1));
    elbow.see(pose);
    seen.push_back(pose);
  }
  for (const Pose& pose : seen) EXPECT_TRUE(elbow.rowsAt(pose, 0.0).empty());
}

TEST(JointRanges, LearnNothingFromLostJoints) {
  Elbow elbow;
  elbow.see(elbow.turned(0.0, Vector3d::UnitY()));
  elbow.isLost[elbow.joint] = 1;
  elbow.see(elbow.turned(2.0, Vector3d::UnitY()));
  EXPECT_FALSE(elbow.rowsAt(elbow.turned(2.0, Vector3d::UnitY()), 0.0).empty());
}

/// A row's normal is how its gap changes with a small turn of the link on its parent, in W.
TEST(JointRanges, RowsPointWhereTheirGapsGrow) {
  test::Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    Elbow elbow;
    elbow.see(elbow.turned(random.uniform(0.0, 1.0), random.direction()));
    Pose pose = restPose(elbow.skeleton);
    for (Quaternion& q : pose.rotations) q = random.turn(random.uniform(0.0, 1.5));
    const Quaternion before = pose.rotations[elbow.joint];
    const auto rows = elbow.rowsAt(pose, 1e3);
    ASSERT_EQ(rows.size(), 6u);
    const auto states = elbow.placed(pose);
    const Eigen::Matrix3d R_WP = states[slotOf(rows[0].other)].R_WL;
    const double h = 1e-6;
    for (const ContactRow& row : rows) {
      EXPECT_NEAR(elbow.ranges.gapAt(states, row), row.gap, 1e-12);
      for (int i = 0; i < 3; ++i) {
        const Vector3d axis_P = R_WP.transpose() * Vector3d::Unit(i);
        pose.rotations[elbow.joint] = Quaternion(Eigen::AngleAxisd(h, axis_P)) * before;
        const double more = elbow.ranges.gapAt(elbow.placed(pose), row);
        pose.rotations[elbow.joint] = Quaternion(Eigen::AngleAxisd(-h, axis_P)) * before;
        const double less = elbow.ranges.gapAt(elbow.placed(pose), row);
        EXPECT_NEAR((more - less) / (2.0 * h), row.n[i], 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace foretouch::internal
