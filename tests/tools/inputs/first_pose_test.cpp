// Whether a body stands as its clip begins, and what options and files say of units and axes.
#include "tools/inputs/first_pose.h"

#include <gtest/gtest.h>

#include "assets/avatar/joint_match.h"
#include "assets/bvh/bvh_reader.h"

namespace foretouch::tools {
namespace {

/// A person of 1.7 m, with y along the body, turned by `turns` (degrees about z, x, y) in its first
/// frame. `head`: its joint's name.
Clip personTurned(const std::string& turns, const std::string& head = "Head") {
  std::string text =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition "
      "Zposition Zrotation Xrotation Yrotation\nJOINT Spine\n{\nOFFSET 0 0.2 0\nCHANNELS 3 "
      "Zrotation Xrotation Yrotation\nJOINT " +
      head +
      "\n{\nOFFSET 0 0.5 0\nCHANNELS 3 Zrotation "
      "Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 0.2 0\n}\n}\n}\n";
  for (const char* const side : {"Left", "Right"}) {
    const std::string name = side;
    text += "JOINT " + name +
            "UpLeg\n{\nOFFSET 0.1 0 0\nCHANNELS 3 Zrotation Xrotation "
            "Yrotation\nJOINT " +
            name +
            "Leg\n{\nOFFSET 0 -0.4 0\nCHANNELS 3 Zrotation Xrotation "
            "Yrotation\nJOINT " +
            name +
            "Foot\n{\nOFFSET 0 -0.4 0\nCHANNELS 3 Zrotation Xrotation "
            "Yrotation\nEnd Site\n{\nOFFSET 0 0 0.1\n}\n}\n}\n}\n";
  }
  text += "}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 1 0 " + turns;
  for (int i = 0; i < 24; ++i) text += " 0";
  auto clip = parseBvh(text + "\n", "person.bvh");
  if (clip.ok()) return std::move(clip).value();
  ADD_FAILURE() << describe(clip.error());
  return {};
}

std::string remarkOn(const Clip& clip, UpAxis readWith = UpAxis::Y) {
  const Avatar avatar = avatarFromClip(clip).value();
  const JointMatch match = matchJoints(avatar.skeleton(), clip.skeleton).value();
  FileFrame frame;
  frame.up = readWith;
  Placement placement;
  placement.motionUpZ = readWith == UpAxis::Z;
  const Pose pose =
      placed(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match, 0), placement);
  return remarkOnFirstPose(avatar, pose, frame, "walk.bvh").value_or("");
}

TEST(RemarkOnFirstPose, HoldsItsTongueAboutWhoStandsOrBends) {
  for (const char* const turns : {"0 0 0", "0 0 90", "0 40 0", "-50 0 0"}) {
    EXPECT_EQ(remarkOn(personTurned(turns)), "") << turns;
  }
}

TEST(RemarkOnFirstPose, NamesTheAxisWithWhichTheBodyStands) {
  // About x by 90 degrees: +y becomes +z, as in a file with Z up.
  const std::string lies = remarkOn(personTurned("0 90 0"));
  EXPECT_EQ(lies.substr(0, 29), "walk.bvh: the first pose lies");
  EXPECT_NE(lies.find("It would stand with --clip-up z, unless it is meant to lie"),
            std::string::npos)
      << lies;
  EXPECT_EQ(remarkOn(personTurned("0 90 0"), UpAxis::Z), "");
  // Turned although it stood.
  EXPECT_NE(remarkOn(personTurned("0 0 0"), UpAxis::Z).find("--clip-up y, unless"),
            std::string::npos);
}

TEST(RemarkOnFirstPose, SaysWhereNoAxisHelps) {
  const std::string aside = remarkOn(personTurned("90 0 0"));
  EXPECT_NE(aside.find("It stands with neither --clip-up y nor z: is it meant to lie?"),
            std::string::npos)
      << aside;
  const std::string headDown = remarkOn(personTurned("180 0 0"));
  EXPECT_NE(headDown.find("has its head below its feet"), std::string::npos) << headDown;
}

TEST(RemarkOnFirstPose, LeavesAloneWhoseHeadItDoesNotKnow) {
  EXPECT_EQ(remarkOn(personTurned("90 0 0", "Thing")), "");
}

TEST(RemarkOnFrame, SpeaksOnlyWhereAnOptionMeetsWhatTheFileSays) {
  const FrameOptions options{"--scene-scale", "--scene-up"};
  FileFrame frame;
  frame.isUnitAsked = frame.isUpAsked = true;
  EXPECT_FALSE(remarkOnFrame(frame, options, "a.obj"));
  frame.declared = {1.0, UpAxis::Y, true};
  EXPECT_FALSE(remarkOnFrame(frame, options, "a.glb"));
  frame.declared = {0.01, UpAxis::Z, false};
  frame.metresPerUnit = 0.01;
  frame.up = UpAxis::Z;
  EXPECT_EQ(remarkOnFrame(frame, options, "a.dae").value_or(""),
            "a.dae: says itself that z is up, so --scene-up z changes nothing; says itself that a "
            "unit is 0.01 m, so --scene-scale 0.01 changes nothing");
  frame.metresPerUnit = 1.0;
  frame.up = UpAxis::Y;
  EXPECT_EQ(remarkOnFrame(frame, options, "a.dae").value_or(""),
            "a.dae: says that z is up, and is read as --scene-up y says; says that a unit is 0.01 "
            "m, and is read as --scene-scale 1 says");
  frame.isUnitAsked = frame.isUpAsked = false;
  EXPECT_FALSE(remarkOnFrame(frame, options, "a.dae"));
}

}  // namespace
}  // namespace foretouch::tools
