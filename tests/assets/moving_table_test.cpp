// Tables of a robot whose root moves: the layouts of public sets, units, rates, and where the root
// and what hangs on it are. Oracle: matrices, multiplied here.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "assets/model/joint_table.h"
#include "assets/model/model_avatar.h"
#include "tests/assets/model_samples.h"
#include "tests/support/holds.h"

namespace foretouch {
namespace {

using internal::parseJointTable;
using test::addNode;
using test::at;
using test::Matrix3d;
using test::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A pelvis with an arm that turns about x; z is up in its file. Where it has it, rows do not care.
Model walker(bool floats = false) {
  Model model;
  model.frame.up = UpAxis::Z;
  std::int32_t base = -1;
  if (floats) base = addNode(model, "world", -1);
  const auto pelvis =
      addNode(model, "pelvis", base, floats ? Vector3d(0, 0, 0) : Vector3d(7, 8, 9));
  const auto arm = addNode(model, "arm", pelvis, {0, 0, 0.5});
  for (const auto node : {pelvis, arm}) {
    model.nodes[at(node)].lss = {{{0, 0, 0}, {0, 0, 0.2}, 0.1}};
  }
  if (floats) model.nodes.front().joint = ModelJointType::Fixed;
  model.nodes[at(arm)].joint = ModelJointType::Revolute;
  model.nodes[at(arm)].jointName = "shoulder";
  model.nodes[at(arm)].axis = {1, 0, 0};
  return model;
}

constexpr char kMoving[] =
    "time,root_qw,shoulder,root_x,root_y,root_z,root_qx,root_qy,root_qz\n"
    "0,1,0,1,2,3,0,0,0\n"
    "0.5,0.5,1.5,4,5,6,0.5,0.5,0.5\n";

/// (x, y, z) with z up is (x, z, -y) with y up.
Vector3d upright(const Vector3d& p) {
  return {p.x(), p.z(), -p.y()};
}

TEST(MovingTable, PutsTheRootWhereTheRowSays) {
  for (const bool floats : {false, true}) {
    const auto clip = clipFromJointPositions(walker(floats), kMoving, "walk.csv");
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    const Clip& read = clip.value();
    ASSERT_EQ(read.frames.size(), 2u);
    const auto pelvis = *read.skeleton.find("pelvis");
    EXPECT_TRUE(read.hasTranslation[at(pelvis)] && read.hasRotation[at(pelvis)]);
    const auto states = test::statesIn(read.skeleton, read.frames[1]);
    Matrix3d turn;  // (0.5, 0.5, 0.5, 0.5): x becomes y, y becomes z
    turn << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const Vector3d root(4, 5, 6);
    EXPECT_LT((states[at(pelvis)].p_WL - (floats ? root : upright(root))).norm(), 1e-12);
    const Vector3d arm = root + turn * Vector3d(0, 0, 0.5);
    const Vector3d found = states[at(*read.skeleton.find("arm"))].p_WL;
    EXPECT_LT((found - (floats ? arm : upright(arm))).norm(), 1e-12) << floats;
  }
}

TEST(MovingTable, MovesTheRootBetweenRowsThatAreCut) {
  const std::string csv =
      "time,shoulder,root_x,root_y,root_z,root_qx,root_qy,root_qz,root_qw\n"
      "0,0,0,0,0,0,0,0,1\n1,5,4,0,0,0,0,1,0\n";
  const Clip clip = clipFromJointPositions(walker(), csv, "a").value();
  ASSERT_EQ(clip.framesPerRow, 2);
  const auto states = test::statesIn(clip.skeleton, clip.frames[1]);
  EXPECT_LT((states[0].p_WL - Vector3d(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((states[0].R_WL.col(0) - upright({0, 1, 0})).norm(), 1e-12);  // half of a half turn
}

TEST(MovingTable, AUnitIsAsTheOptionSays) {
  JointTableOptions options;
  options.isInDegrees = true;
  options.metresPerUnit = 0.01;
  const Clip clip = clipFromJointPositions(walker(), kMoving, "a", options).value();
  const auto states = test::statesIn(clip.skeleton, clip.frames[1]);
  EXPECT_LT((states[0].p_WL - upright({0.04, 0.05, 0.06})).norm(), 1e-12);
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(clip.frames[1].rotations[1]));
  EXPECT_NEAR(turn.angle(), 1.5 * kDegree, 1e-12);
}

TEST(MovingTable, ARateStandsInForTimes) {
  JointTableOptions options;
  options.columns = {"shoulder", "root_x"};
  options.rateHz = 50.0;
  const auto table = parseJointTable("0.5,1\n0.25,2\n", options);
  ASSERT_TRUE(table.ok()) << describe(table.error());
  EXPECT_EQ(table.value().frameTimeS, 0.02);
  EXPECT_EQ(table.value().joints, options.columns);  // one column of seven is no root
  EXPECT_TRUE(table.value().roots.empty());
  options.columns.clear();
  EXPECT_TRUE(parseJointTable("shoulder\n0.5\n0.25\n", options).ok());
}

std::string numbers(std::size_t count, double first, double step) {
  std::string row;
  for (std::size_t i = 0; i < count; ++i) {
    row += (i == 0 ? "" : ",") + std::to_string(first + step * static_cast<double>(i));
  }
  return row;
}

TEST(MovingTable, KnowsTheLayoutOfRetargetedLafan1) {
  JointTableOptions options;
  options.columns = {"lafan1-g1"};
  const std::string joints = numbers(29, 0.0, 0.01);
  const auto table = parseJointTable(
      "1,2,0.75,0.6,0,0,0.8," + joints + "\n1,2,3,0,0,0,1," + joints + "\n", options);
  ASSERT_TRUE(table.ok()) << describe(table.error());
  const internal::JointTable& read = table.value();
  EXPECT_EQ(read.frameTimeS, 1.0 / 30.0);
  EXPECT_EQ(read.roots[0].translation, Vector3d(1, 2, 0.75));
  EXPECT_EQ(read.roots[0].rotation.x(), 0.6);
  EXPECT_EQ(read.roots[0].rotation.w(), 0.8);
  ASSERT_EQ(read.joints.size(), 29u);
  EXPECT_EQ(read.joints[0], "left_hip_pitch_joint");
  EXPECT_EQ(read.joints[11], "right_ankle_roll_joint");
  EXPECT_EQ(read.joints[13], "waist_roll_joint");
  EXPECT_EQ(read.joints[28], "right_wrist_yaw_joint");
  EXPECT_EQ(read.rows[1][28], 0.28);
  EXPECT_FALSE(parseJointTable("1,2,3,0,0,0,1," + numbers(28, 0, 1) + "\n", options).ok());
}

TEST(MovingTable, KnowsTheLayoutOfBonesSeed) {
  JointTableOptions options;
  options.columns = {"bones-seed-g1"};
  const auto table = parseJointTable(
      "Frame,root_translateX,root_translateY,root_translateZ,root_rotateX,root_rotateY,"
      "root_rotateZ,left_hip_pitch_joint_dof\n"
      "0,10,20,80,30,40,50,90\n1,10,20,80,0,0,0,45\n",
      options);
  ASSERT_TRUE(table.ok()) << describe(table.error());
  const internal::JointTable& read = table.value();
  EXPECT_EQ(read.frameTimeS, 1.0 / 120.0);
  EXPECT_EQ(read.joints, std::vector<std::string>{"left_hip_pitch_joint"});
  EXPECT_LT((read.roots[0].translation - Vector3d(0.1, 0.2, 0.8)).norm(), 1e-12);
  const auto about = [](double degrees, int i, int j) {  // from axis i towards axis j
    Matrix3d turn = Matrix3d::Identity();
    turn(i, i) = turn(j, j) = std::cos(degrees * kDegree);
    turn(j, i) = std::sin(degrees * kDegree);
    turn(i, j) = -turn(j, i);
    return turn;
  };
  const Matrix3d expected = about(50, 0, 1) * about(40, 2, 0) * about(30, 1, 2);
  EXPECT_LT((read.roots[0].rotation.toRotationMatrix() - expected).norm(), 1e-12);
  EXPECT_NEAR(read.rows[0][0] * read.radiansPerUnit, 90 * kDegree, 1e-12);
}

struct TableRefusal {
  std::string csv;
  JointTableOptions options;
  std::string says;
  std::int64_t line = -1;
};

TEST(MovingTable, RefusesWhatItWouldHaveToGuess) {
  JointTableOptions named, rate, unknown, both;
  named.columns = {"shoulder", "elbow"};
  rate.rateHz = 30.0;
  unknown.columns = {"lafan1-g2"};
  both.rateHz = 30.0;
  const std::string root = "time,root_x,root_y,root_z,root_qx,root_qy,root_qz,root_qw\n";
  for (const TableRefusal& refusal : std::vector<TableRefusal>{
           {"0.5,0.5\n0.1,0.1\n", {}, "begins with time, found '0.5'", 1},
           {"0.5,0.5\n0.1,0.1\n", named, "expected a column time, or"},
           {"time,shoulder\n0,0\n1,1\n", both, "expected no rate beside them"},
           {"1,2\n", unknown, "did you mean 'lafan1-g1'"},
           {"shoulder\n0\n", rate, "at least 2 rows"},
           {root + "0,0,0,0,0,0,0,1\n1,0,0,0,0,0,0,2\n", {}, "the norm 1 within 0.001, found 2", 3},
           {root + "0,0,0,0,0,0,0,1\n1,2e7,0,0,0,0,0,1\n", {}, "within 1e7 m", 3},
       }) {
    const auto table = parseJointTable(refusal.csv, refusal.options);
    ASSERT_FALSE(table.ok()) << refusal.says;
    EXPECT_NE(describe(table.error()).find(refusal.says), std::string::npos)
        << describe(table.error());
    EXPECT_EQ(table.error().line, refusal.line) << refusal.says;
  }
  const auto partly =
      clipFromJointPositions(walker(), "time,shoulder,root_x\n0,0,0\n1,0,0\n", "a.csv");
  ASSERT_FALSE(partly.ok());
  EXPECT_NE(describe(partly.error()).find("has all of root_x, root_y"), std::string::npos);
}

}  // namespace
}  // namespace foretouch
