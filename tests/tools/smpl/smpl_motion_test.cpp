// Motions of SMPL against numpy: files as numpy saves them, joints where its matrices have them.
#include "tools/inputs/smpl_motion.h"

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/humanoid_rest.h"
#include "assets/human_bones.h"
#include "tests/support/holds.h"
#include "tests/support/temp_folder.h"

namespace foretouch::tools {
namespace {

class SmplMotions : public testing::Test {
 protected:
  void SetUp() override {
    const std::string make =
        "/usr/bin/python3 -c 'import numpy' 2>/dev/null && /usr/bin/python3 " FORETOUCH_SMPL_ORACLE
        " ";
    if (std::system((make + folder_.path()).c_str()) != 0) GTEST_SKIP() << "numpy is absent";
  }
  [[nodiscard]] Result<Clip> read(const std::string& motion, const std::string& body = "body.npz",
                                  std::optional<double> rateHz = {}) const {
    return clipFromSmpl(folder_ / motion, folder_ / body, rateHz);
  }
  test::TempFolder folder_;
};

TEST_F(SmplMotions, PutJointsWhereNumpyDoes) {
  const auto read = this->read("motion.npz");
  ASSERT_TRUE(read.ok()) << describe(read.error());
  const Clip& clip = read.value();
  EXPECT_EQ(clip.skeleton.numJoints(), 24);
  EXPECT_EQ(clip.frames.size(), 5u);
  EXPECT_NEAR(clip.frameTimeS, 1.0 / 120.0, 1e-15);
  EXPECT_TRUE(clip.skeleton.find("left_shoulder"));
  EXPECT_EQ(humanBonesOf(clip.skeleton).at("leftLowerArm"), clip.skeleton.find("left_elbow"));
  std::ifstream expected(folder_ / "expected.txt");
  int compared = 0;
  for (const Pose& frame : clip.frames) {
    for (const RigidPose& place : placesIn(clip.skeleton, frame)) {
      Eigen::Vector3d p;
      ASSERT_TRUE(expected >> p.x() >> p.y() >> p.z());
      EXPECT_LT((place.translation - p).norm(), 1e-12);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 5 * 24);
  ASSERT_EQ(clip.notes.size(), 1u);
  EXPECT_TRUE(test::holds(clip.notes[0], "the last 1 of its 4 betas are left out"))
      << clip.notes[0];
}

TEST_F(SmplMotions, NamesFileAndArray) {
  struct Case {
    const char *motion, *body, *expected;
  };
  for (const Case& each : std::vector<Case>{
           {"none.npz", "body.npz", "none.npz"},
           {"motion.npz", "none.npz", "none.npz"},
           {"body.npz", "body.npz", "body.npz: "},
           {"motion.npz", "motion.npz", "v_template"},
           {"motion.npz", "flat.npz", "shapedirs"},
           {"motion.npz", "wide.npz",
            "array 'J_regressor': expected a column for each of the 39 vertices"},
           {"motion.npz", "late.npz",
            "array 'kintree_table': expected parents before their children"},
           {"unrated.npz", "body.npz", "expected an array 'mocap_framerate'"},
           {"hands.npz", "body.npz",
            "array 'poses': expected 3 columns for each of the body model's 24 joints, found 156"},
           {"short.npz", "body.npz", "array 'trans': expected three numbers for each row"}}) {
    const auto read = this->read(each.motion, each.body);
    ASSERT_FALSE(read.ok()) << each.expected;
    EXPECT_TRUE(test::holds(describe(read.error()), each.expected)) << describe(read.error());
  }
  EXPECT_TRUE(read("unrated.npz", "flat.npz", 30.0).ok());
  EXPECT_TRUE(read("still.npz", "flat.npz").ok());  // without shapes, where none is asked for
}

}  // namespace
}  // namespace foretouch::tools
