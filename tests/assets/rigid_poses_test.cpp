// Tests assets/clip/rigid_poses.h.
#include "assets/clip/rigid_poses.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"

namespace foretouch::test {
namespace {

TEST(RigidPoses, ReadsPlacesAndRotationsInAnyOrderOfColumns) {
  const auto read = parseRigidPoses(
      "time,qx,qy,qz,qw,z,y,x\n-1.5,0,0,0,1,3,2,1\n# a comment\n0.25,0,1.0001,0,0,6,5,4\n",
      "ball.csv");
  ASSERT_TRUE(read.ok()) << describe(read.error());
  ASSERT_EQ(read.value().size(), 2u);
  EXPECT_EQ(read.value()[0].timeS, -1.5);
  EXPECT_EQ(read.value()[0].line, 2);
  EXPECT_EQ(read.value()[0].pose.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read.value()[1].line, 4);
  EXPECT_NEAR(read.value()[1].pose.rotation.norm(), 1.0, 1e-15);
  EXPECT_NEAR(read.value()[1].pose.rotation.y(), 1.0, 1e-15);
}

TEST(RigidPoses, NeedNoRotation) {
  const auto read = parseRigidPoses("time,x,y,z\n0,1,2,3\n", "ball.csv");
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_EQ(read.value()[0].pose.rotation.w(), 1.0);
}

TEST(RigidPoses, SayWhatIsWrongAndWhere) {
  struct Broken {
    std::string text;
    int line;
    std::string says;
  };
  const std::vector<Broken> cases{
      {"", -1, "expected a header"},
      {"time,x,y\n0,1,2\n", -1, "expected a column 'z'"},
      {"time,x,y,z,qw\n0,1,2,3,1\n", -1, "expected a column 'qx'"},
      {"time,x,y,z,yaw\n0,1,2,3,1\n", -1, "found 'yaw'"},
      {"time,x,y,z\n", -1, "expected at least one pose"},
      {"time,x,y,z\n0,1,2\n", 2, "expected 4 cells"},
      {"time,x,y,z\n0,1,2,nan\n", 2, "expected a number"},
      {"time,x,y,z\n0,1,2,1e8\n", 2, "within 1e7 m"},
      {"time,x,y,z\n0,1,2,3\n0,1,2,3\n", 3, "expected a time after 0 s"},
      {"time,x,y,z\n1,1,2,3\n0.5,1,2,3\n", 3, "found 0.5 s"},
      {"time,x,y,z,qw,qx,qy,qz\n0,1,2,3,0,0,0,0\n", 2, "norm 1 within 0.001, found 0"},
  };
  for (const Broken& broken : cases) {
    const auto read = parseRigidPoses(broken.text, "ball.csv");
    ASSERT_FALSE(read.ok()) << broken.text;
    EXPECT_EQ(read.error().file, "ball.csv");
    EXPECT_EQ(read.error().line, broken.line) << describe(read.error());
    EXPECT_TRUE(holds(read.error().message, broken.says)) << describe(read.error());
  }
}

}  // namespace
}  // namespace foretouch::test
