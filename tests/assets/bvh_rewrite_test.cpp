// A BVH file with another motion: what stays, letter by letter, and what reads back.
#include "assets/bvh/bvh_rewrite.h"

#include <string>

#include <gtest/gtest.h>

#include "assets/bvh/bvh_reader.h"

namespace foretouch {
namespace {

/// Odd spacing, digits and line ends, positions behind angles, and a hinge.
constexpr char kText[] =
    "HIERARCHY\r\nROOT hips\r\n{\r\n OFFSET 0 0 0\r\n CHANNELS 6 Zrotation Yrotation Xrotation "
    "Xposition Yposition Zposition\r\n JOINT knee\r\n {\r\n  OFFSET 0 -40 0\r\n  CHANNELS 1 "
    "Xrotation\r\n  JOINT foot\r\n  {\r\n   OFFSET 0 -40 0\r\n   CHANNELS 3 Xrotation Yrotation "
    "Zrotation\r\n   End Site\r\n   {\r\n    OFFSET 0 0 10\r\n   }\r\n  }\r\n }\r\n}\r\nMOTION\r\n"
    "Frames: 2\r\nFrame Time: 0.01\r\n"
    "10.50\t-20 30.125   1e1 90.0 -0.5  15 1 2 3\r\n"
    "370.5 -20 30 10 90 0  -170 89.9999 2 3\r\n";

Clip clipOf(const std::string& text) {
  auto clip = parseBvh(text, "a.bvh", BvhOptions{0.01});
  EXPECT_TRUE(clip.ok());
  return std::move(clip).value();
}

Quaternion turned(const Quaternion& rotation, const Eigen::Vector3d& by) {
  const Eigen::AngleAxisd turn(by.norm(), by.normalized());
  return Quaternion((Eigen::Quaterniond(rotation) * turn).normalized());
}

TEST(BvhRewrite, KeepsEveryByteOfWhatDoesNotChange) {
  const Clip clip = clipOf(kText);
  const auto same = rewriteBvh(kText, "a.bvh", 0.01, clip, clip.frames);
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same.value(), kText);

  std::vector<Pose> after = clip.frames;
  after[0].translations[0].y() += 0.012;
  const auto raised = rewriteBvh(kText, "a.bvh", 0.01, clip, after);
  ASSERT_TRUE(raised.ok());
  std::string expected = kText;
  expected.replace(expected.find("90.0 -0.5"), 4, "91.200000");
  EXPECT_EQ(raised.value(), expected);
}

/// Every joint turns: the text reads back as what was asked for, also where two axes nearly meet,
/// and angles stay near the old ones.
TEST(BvhRewrite, ReadsBackAsAskedFor) {
  const Clip clip = clipOf(kText);
  std::vector<Pose> after = clip.frames;
  for (Pose& pose : after) {
    pose.rotations[0] = turned(pose.rotations[0], {0.02, -0.03, 0.05});
    pose.rotations[1] = turned(pose.rotations[1], {-0.1, 0.0, 0.0});
    pose.rotations[2] = turned(pose.rotations[2], {0.01, 0.02, -0.01});
  }
  const auto text = rewriteBvh(kText, "a.bvh", 0.01, clip, after);
  ASSERT_TRUE(text.ok());
  const Clip read = clipOf(text.value());
  for (std::size_t frame = 0; frame < 2; ++frame) {
    for (std::size_t joint = 0; joint < 3; ++joint) {
      EXPECT_LT(Eigen::Quaterniond(read.frames[frame].rotations[joint])
                    .angularDistance(Eigen::Quaterniond(after[frame].rotations[joint])),
                1e-7)
          << frame << " " << joint;
    }
  }
  EXPECT_NE(text.value().find("\r\n37"), std::string::npos) << "370.5 stays near 370.5";
}

TEST(BvhRewrite, RefusesWhatTheChannelsCannotSay) {
  const Clip clip = clipOf(kText);
  std::vector<Pose> after = clip.frames;
  after[1].translations[1].x() += 0.01;
  const auto moved = rewriteBvh(kText, "a.bvh", 0.01, clip, after);
  ASSERT_FALSE(moved.ok());
  EXPECT_EQ(moved.error().index, 1);
  EXPECT_NE(moved.error().message.find("'knee'"), std::string::npos) << moved.error().message;
}

}  // namespace
}  // namespace foretouch
