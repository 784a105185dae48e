// importRobot(): a URDF as a robot, and what it refuses by name. Kinematics are held against
// numbers worked out by hand.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "assets/import/model_import.h"
#include "tests/assets/urdf_files.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr double kHalfTurn = 3.14159265358979323846;

std::string limit(const std::string& lower, const std::string& upper) {
  return "<limit lower=\"" + lower + "\" upper=\"" + upper + "\" effort=\"1\" velocity=\"1\"/>";
}

class ImportRobot : public ImportUrdf {
 protected:
  Result<ImportedRobot> read(const std::string& content) {
    RobotImportOptions options;
    options.reading = withModelImporter();
    return importRobot(folder_.write("robot.urdf", robot(content)), options);
  }
  Robot robotOf(const std::string& content) {
    auto result = read(content);
    if (!result.ok()) throw std::runtime_error(describe(result.error()));
    return std::move(result).value().made.robot;
  }
  void expectRefusal(const std::string& content, const std::string& reason) {
    const auto result = read(content);
    ASSERT_FALSE(result.ok()) << reason;
    EXPECT_NE(describe(result.error()).find(reason), std::string::npos) << describe(result.error());
  }
};

/// Where the origin of a link's frame is.
Vector3d originOf(const Robot& robot, const char* link, const std::vector<double>& q) {
  Pose pose;
  robot.poseAt(q.data(), pose);
  const Skeleton& skeleton = robot.avatar().skeleton();
  Vector3d p = Vector3d::Zero();
  for (JointId j = *skeleton.find(link); j != kNoParent; j = skeleton.parent(j)) {
    const auto i = static_cast<std::size_t>(j);
    p = pose.rotations[i] * p + pose.translations[i];
  }
  return p;
}

TEST_F(ImportRobot, MovesByTheCoordinatesOfItsJoints) {
  const std::string z = "<axis xyz=\"0 0 2\"/>", out = "<origin xyz=\"1 0 0\"/>";
  const Robot robot =
      robotOf(linkWith(kSphere, "base") + linkWith(kSphere, "a") + linkWith(kSphere, "b") +
              linkWith(kSphere, "c") + linkWith(kSphere, "d") + linkWith(kSphere, "e") +
              joint("revolute", "base", "a", z + out + limit("-4", "4")) +
              joint("continuous", "a", "b", z + out) +
              joint("prismatic", "b", "c", "<axis xyz=\"1 0 0\"/>" + out + limit("0", "0.5")) +
              joint("fixed", "c", "d", out) +
              joint("prismatic", "d", "e",
                    "<axis xyz=\"-1 0 0\"/>" + out + limit("-9", "9") +
                        "<mimic joint=\"to_c\" multiplier=\"-2\" offset=\"0.25\"/>"));
  ASSERT_EQ(robot.numCoordinates(), 3U);
  EXPECT_EQ(robot.coordinates()[0].name, "to_a");
  EXPECT_EQ(robot.coordinates()[0].lower, -4.0);
  EXPECT_TRUE(robot.coordinates()[1].isPeriodic);
  EXPECT_FALSE(robot.coordinates()[2].isAngle);
  EXPECT_EQ(robot.coordinates()[2].upper, 0.5);
  // a at (1, 0) turned by a quarter; b one above it, turned on to look back along -x; then slides.
  const std::vector<double> q{kHalfTurn / 2, kHalfTurn / 2, 0.25};
  EXPECT_LT((originOf(robot, "a", q) - Vector3d(1, 0, 0)).norm(), 1e-14);
  EXPECT_LT((originOf(robot, "b", q) - Vector3d(1, 1, 0)).norm(), 1e-14);
  EXPECT_LT((originOf(robot, "c", q) - Vector3d(-0.25, 1, 0)).norm(), 1e-14);
  EXPECT_LT((originOf(robot, "d", q) - Vector3d(-1.25, 1, 0)).norm(), 1e-14);
  // Its own coordinate is -2 * 0.25 + 0.25 = -0.25, along -x: on by another 0.25.
  EXPECT_LT((originOf(robot, "e", q) - Vector3d(-2.5, 1, 0)).norm(), 1e-14);
}

TEST_F(ImportRobot, ReadsAMobileBase) {
  const Robot robot =
      robotOf(linkWith(kSphere, "ground") + linkWith(kSphere, "base") + linkWith(kSphere, "arm") +
              joint("planar", "ground", "base", "<axis xyz=\"0 0 1\"/>") +
              joint("fixed", "base", "arm", "<origin xyz=\"1 0 0\"/>"));
  ASSERT_EQ(robot.numCoordinates(), 3U);
  EXPECT_EQ(robot.coordinates()[2].name, "to_base/angle");
  EXPECT_LT((originOf(robot, "arm", {3, 4, kHalfTurn / 2}) - Vector3d(3, 5, 0)).norm(), 1e-14);
}

TEST_F(ImportRobot, RefusesByNameWhatAPlannerCannotDoWithout) {
  const std::string two = linkWith(kSphere, "a") + linkWith(kSphere, "b");
  expectRefusal(two + joint("revolute", "a", "b", limit("1", "-1")), "'to_b' has its lower limit");
  expectRefusal(two + joint("prismatic", "a", "b", limit("0.5", "0.5")), "'to_b' states no limits");
  expectRefusal(two + joint("revolute", "a", "b"), "'to_b' states no limits");
  expectRefusal(two + joint("floating", "a", "b"), "'to_b' is floating");
  expectRefusal(two + joint("continuous", "a", "b", "<mimic joint=\"gone\"/>"),
                "'to_b' mimics 'gone'");
  expectRefusal(two + joint("continuous", "a", "b", "<mimic joint=\"to_b\"/>"),
                "follows a joint that follows another one, or itself");
  expectRefusal(linkWith("<mesh filename=\"gone.stl\"/>"), "mesh 'gone.stl' of link 'a'");
  // A mesh that is there beside one that is not is no whole robot.
  folder_.write("there.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expectRefusal(
      "<link name=\"a\"><collision><geometry><mesh filename=\"there.obj\"/></geometry>"
      "</collision><collision><geometry><mesh filename=\"gone.stl\"/></geometry>"
      "</collision></link>",
      "mesh 'gone.stl' of link 'a'");
  EXPECT_TRUE(read(linkWith("<mesh filename=\"there.obj\"/>")).ok());
  // An avatar can do without, with a note.
  EXPECT_TRUE(mentions(imported(two + joint("revolute", "a", "b")).notes, "states no limits"));
}

TEST(RobotOfModel, RefusesWhatHangsOnNoJoint) {
  Model model;
  model.nodes.resize(2);
  model.nodes[0].name = "base";
  model.nodes[0].lss = {{Vector3d::Zero(), Vector3d::Zero(), 0.1}};
  model.nodes[1] = model.nodes[0];
  model.nodes[1].name = "loose";
  model.nodes[1].parent = 0;
  const auto result = robotFromModel(model);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().index, 1);
  EXPECT_NE(result.error().message.find("'loose'"), std::string::npos);
}

TEST(RobotOfModel, PandaStandsWhereItsDataSheetSays) {
  FORETOUCH_REQUIRE_SHARED(urdf, "robots/franka_panda/panda.urdf");
  RobotImportOptions options;
  options.reading = withModelImporter();
  const auto panda = importRobot(*urdf, options);
  ASSERT_TRUE(panda.ok()) << describe(panda.error());
  const Robot& robot = panda.value().made.robot;
  // Seven of the arm, and one finger that the other one follows.
  ASSERT_GE(robot.numCoordinates(), 8U);
  std::vector<double> q(robot.numCoordinates(), 0.0);
  // 0.333 + 0.316 + 0.384 - 0.107 above the base, and 0.088 in front of it.
  EXPECT_LT((originOf(robot, "panda_link8", q) - Vector3d(0.088, 0, 0.926)).norm(), 1e-9);
  q[1] = kHalfTurn / 2;  // the whole arm lies along +x, at the shoulder's height
  EXPECT_LT((originOf(robot, "panda_link8", q) - Vector3d(0.593, 0, 0.333 - 0.088)).norm(), 1e-9);
}

TEST(RobotOfModel, ReadsAnIiwa) {
  FORETOUCH_REQUIRE_SHARED(urdf, "robots/kuka_iiwa/model.urdf");
  RobotImportOptions options;
  options.reading = withModelImporter();
  const auto iiwa = importRobot(*urdf, options);
  ASSERT_TRUE(iiwa.ok()) << describe(iiwa.error());
  EXPECT_EQ(iiwa.value().made.robot.numCoordinates(), 7U);
}

}  // namespace
}  // namespace foretouch::test
