// What BVH files in the wild do and the reader bears with, mostly with a note. Each case bends the
// plain sample and must still give its poses.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/bvh/bvh_reader.h"
#include "tests/assets/bvh_samples.h"

namespace foretouch {
namespace {

using test::edited;
using test::editedAll;
using test::plainBvh;

/// Expects the text to give the plain sample's skeleton and poses, and returns the notes.
std::vector<std::string> notesOfEqualClip(const std::string& text) {
  const auto plain = parseBvh(plainBvh(), "plain.bvh");
  const auto clip = parseBvh(text, "test.bvh");
  if (!plain.ok() || !clip.ok()) {
    ADD_FAILURE() << (plain.ok() ? describe(clip.error()) : describe(plain.error()));
    return {};
  }
  const Clip& a = plain.value();
  const Clip& b = clip.value();
  EXPECT_EQ(b.skeleton.numJoints(), a.skeleton.numJoints());
  EXPECT_EQ(b.frames.size(), a.frames.size());
  EXPECT_EQ(b.frameTimeS, a.frameTimeS);
  EXPECT_EQ(b.endSites, a.endSites);
  if (b.skeleton.numJoints() != a.skeleton.numJoints() || b.frames.size() != a.frames.size()) {
    return {"not comparable"};
  }
  for (JointId j = 0; j < a.skeleton.numJoints(); ++j) {
    EXPECT_EQ(b.skeleton.parent(j), a.skeleton.parent(j));
    EXPECT_EQ(b.skeleton.restOffset(j), a.skeleton.restOffset(j));
    for (std::size_t f = 0; f < a.frames.size(); ++f) {
      const auto i = static_cast<std::size_t>(j);
      EXPECT_EQ(b.frames[f].rotations[i].coeffs(), a.frames[f].rotations[i].coeffs());
      EXPECT_EQ(b.frames[f].translations[i], a.frames[f].translations[i]);
    }
  }
  return b.notes;
}

void expectOneNote(const std::string& text, const std::string& about) {
  const auto notes = notesOfEqualClip(text);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find(about), std::string::npos) << notes[0];
}

TEST(BvhQuirks, LineEndsOfEverySystem) {
  EXPECT_TRUE(notesOfEqualClip(editedAll(plainBvh(), "\n", "\r\n")).empty());
  EXPECT_TRUE(notesOfEqualClip(editedAll(plainBvh(), "\n", "\r")).empty());
}

TEST(BvhQuirks, TabsAndBlankLinesAnywhere) {
  EXPECT_TRUE(notesOfEqualClip(editedAll(plainBvh(), " ", "\t")).empty());
  EXPECT_TRUE(notesOfEqualClip(editedAll(plainBvh(), "\n", " \t\n\n")).empty());
}

TEST(BvhQuirks, ByteOrderMark) {
  EXPECT_TRUE(notesOfEqualClip("\xef\xbb\xbf" + plainBvh()).empty());
}

TEST(BvhQuirks, NoLineBreakAtTheEnd) {
  std::string text = plainBvh();
  text.pop_back();
  EXPECT_TRUE(notesOfEqualClip(text).empty());
}

TEST(BvhQuirks, KeywordsInAnyCase) {
  std::string text = plainBvh();
  for (const char* word : {"HIERARCHY", "ROOT", "JOINT", "OFFSET", "CHANNELS", "MOTION"}) {
    std::string lower(word);
    for (char& c : lower) c = static_cast<char>(c - 'A' + 'a');
    text = editedAll(text, word, lower);
  }
  text = editedAll(edited(edited(text, "Frames", "FRAMES"), "Frame Time", "FRAME TIME"), "rotation",
                   "ROTATION");
  EXPECT_TRUE(notesOfEqualClip(text).empty());
}

TEST(BvhQuirks, EndSiteUnderItsOtherNames) {
  for (const char* name :
       {"END SITE", "End_Site", "EndSite", "end-site", "End effector tip", "End"}) {
    EXPECT_TRUE(notesOfEqualClip(edited(plainBvh(), "End Site", name)).empty()) << name;
  }
}

TEST(BvhQuirks, BracesOnTheLineOfTheName) {
  EXPECT_TRUE(notesOfEqualClip(editedAll(plainBvh(), "\n{", " {")).empty());
  EXPECT_TRUE(notesOfEqualClip(edited(plainBvh(), "ROOT Hips\n{", "ROOT Hips{")).empty());
}

TEST(BvhQuirks, HierarchyOnOneLine) {
  std::string text = plainBvh();
  const std::size_t motion = text.find("MOTION");
  EXPECT_TRUE(
      notesOfEqualClip(editedAll(text.substr(0, motion), "\n", " ") + text.substr(motion)).empty());
}

TEST(BvhQuirks, OddSpacingOfTheMotionHeader) {
  for (const char* header :
       {"Frames:2\nFrame Time:0.025\n", "Frames :\t2\nFrame Time :0.025\n",
        "Frames\t:\t2\nFrame  Time\t:\t.025\n", "Frames 2\nFrameTime: 2.5e-2\n",
        "Frame Time: +0.025\nFrames: +2\n", "Frames: 2.0 Frame_Time: 25E-3\n"}) {
    EXPECT_TRUE(
        notesOfEqualClip(edited(plainBvh(), "Frames: 2\nFrame Time: 0.025\n", header)).empty())
        << header;
  }
}

TEST(BvhQuirks, NumbersInEverySpelling) {
  EXPECT_TRUE(notesOfEqualClip(edited(plainBvh(), "1 2 3 10 20 30 40 50 60",
                                      "+1 2. 0.3e1 1e1 2E+1 +3.0e+01 40.000 .5e2 6000e-2"))
                  .empty());
  EXPECT_TRUE(
      notesOfEqualClip(edited(plainBvh(), "OFFSET 0 2 0.5", "OFFSET -0e5 2e0 5.e-1")).empty());
}

TEST(BvhQuirks, NumbersTooSmallForADoubleAreZero) {
  EXPECT_TRUE(
      notesOfEqualClip(edited(plainBvh(), "OFFSET 0 2 0.5", "OFFSET 1e-400 2 0.5")).empty());
  const std::string tiny = "0." + std::string(400, '0') + "1";
  EXPECT_TRUE(
      notesOfEqualClip(edited(plainBvh(), "OFFSET 0 2 0.5", "OFFSET " + tiny + " 2 0.5")).empty());
  // A long way round to an ordinary number.
  const std::string two = "2" + std::string(400, '0') + "e-400";
  EXPECT_TRUE(
      notesOfEqualClip(edited(plainBvh(), "OFFSET 0 2 0.5", "OFFSET 0 " + two + " 0.5")).empty());
}

TEST(BvhQuirks, FewerFramesDeclaredThanThere) {
  expectOneNote(edited(plainBvh(), "Frames: 2", "Frames: 1"), "declares 1 frames and holds 2");
}

TEST(BvhQuirks, MoreFramesDeclaredThanThere) {
  expectOneNote(edited(plainBvh(), "Frames: 2", "Frames: 3070"),
                "declares 3070 frames and holds 2");
}

TEST(BvhQuirks, FramesSpreadOverLines) {
  expectOneNote(edited(plainBvh(), "1 2 3 10 20 30", "1 2 3\n10 20 30"), "line 20");
  expectOneNote(edited(plainBvh(), "60\n4", "60 4"), "line 19");
}

TEST(BvhQuirks, MissingHierarchyKeyword) {
  expectOneNote(edited(plainBvh(), "HIERARCHY\n", ""), "HIERARCHY");
}

TEST(BvhQuirks, MissingRootKeyword) {
  expectOneNote(edited(plainBvh(), "ROOT Hips", "Hips"), "lacks the keyword ROOT");
  expectOneNote(edited(plainBvh(), "ROOT Hips", "JOINT Hips"), "instead of ROOT");
}

TEST(BvhQuirks, MissingOffsetCountsAsZero) {
  const auto clip = parseBvh(edited(plainBvh(), "    OFFSET 0 2 0.5\n", ""), "test.bvh");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_EQ(clip.value().skeleton.restOffset(1), Eigen::Vector3d::Zero());
  ASSERT_EQ(clip.value().notes.size(), 1u);
  EXPECT_NE(clip.value().notes[0].find("no OFFSET"), std::string::npos);
}

TEST(BvhQuirks, LeafWithoutEndSite) {
  const auto clip =
      parseBvh(edited(plainBvh(), "    End Site\n    {\n      OFFSET 0 3 0\n    }\n", ""), "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_TRUE(clip.value().endSites[1].empty());
  EXPECT_TRUE(clip.value().notes.empty());
}

TEST(BvhQuirks, JointWithoutChannelsKeepsItsRestPose) {
  for (const char* channels : {"", "    CHANNELS 0\n"}) {
    std::string text =
        edited(plainBvh(), "    CHANNELS 3 Zrotation Xrotation Yrotation\n", channels);
    text = edited(edited(text, " 40 50 60", ""), " -40 -50 -60", "");
    const auto clip = parseBvh(text, "t");
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    EXPECT_FALSE(clip.value().hasRotation[1]);
    EXPECT_FALSE(clip.value().hasTranslation[1]);
    EXPECT_EQ(clip.value().frames[0].rotations[1].coeffs(), Quaternion::Identity().coeffs());
    EXPECT_EQ(clip.value().frames[0].translations[1], Eigen::Vector3d(0, 2, 0.5));
    ASSERT_EQ(clip.value().notes.size(), 1u);
    EXPECT_NE(clip.value().notes[0].find("1 of 2 joints have no channels"), std::string::npos);
  }
}

TEST(BvhQuirks, RotationChannelsBeforePositions) {
  std::string text =
      edited(plainBvh(), "Xposition Yposition Zposition Zrotation Xrotation Yrotation",
             "Zrotation Xrotation Yrotation Xposition Yposition Zposition");
  text = edited(edited(text, "1 2 3 10 20 30", "10 20 30 1 2 3"), "4 5 6 -10 -20 -30",
                "-10 -20 -30 4 5 6");
  EXPECT_TRUE(notesOfEqualClip(text).empty());
}

TEST(BvhQuirks, SeveralRoots) {
  std::string text =
      edited(plainBvh(), "MOTION", "ROOT Prop { OFFSET 7 8 9 CHANNELS 1 Yposition }\nMOTION");
  text = edited(edited(text, "40 50 60", "40 50 60 5"), "-40 -50 -60", "-40 -50 -60 6");
  const auto clip = parseBvh(text, "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  ASSERT_EQ(clip.value().skeleton.numJoints(), 3);
  EXPECT_EQ(clip.value().skeleton.parent(2), kNoParent);
  EXPECT_EQ(clip.value().frames[1].translations[2], Eigen::Vector3d(7, 6, 9));
}

TEST(BvhQuirks, SeveralEndSitesOfOneJoint) {
  const auto clip = parseBvh(
      edited(plainBvh(), "    End Site\n", "    End Site { OFFSET 1 1 1 }\n    End Site\n"), "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_EQ(clip.value().endSites[1], (std::vector<Eigen::Vector3d>{{1, 1, 1}, {0, 3, 0}}));
}

TEST(BvhQuirks, NamesWithSpacesColonsAndForeignLetters) {
  for (const char* name :
       {"mixamorig:Left Arm", "Bip01 L Hand", "\xc3\xa0n\xc3\xaem", "JOINT", "-"}) {
    const auto clip = parseBvh(edited(plainBvh(), "Spine", name), "t");
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    EXPECT_EQ(clip.value().skeleton.name(1), name);
    EXPECT_TRUE(clip.value().notes.empty());
  }
}

TEST(BvhQuirks, NameOnTheLineAfterItsKeyword) {
  EXPECT_TRUE(notesOfEqualClip(edited(plainBvh(), "ROOT Hips", "ROOT\n  Hips")).empty());
}

TEST(BvhQuirks, TabsInNamesBecomeSpaces) {
  const auto clip = parseBvh(edited(plainBvh(), "Spine", "Left\tArm \t"), "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_EQ(clip.value().skeleton.name(1), "Left Arm");
}

TEST(BvhQuirks, NamesThatAreNotUtf8AreReadAsLatin1) {
  const auto clip = parseBvh(edited(plainBvh(), "Spine",
                                    "R\xfc"
                                    "cken\x91"),
                             "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_EQ(clip.value().skeleton.name(1),
            "R\xc3\xbc"
            "cken\xef\xbf\xbd");
  ASSERT_EQ(clip.value().notes.size(), 1u);
  EXPECT_NE(clip.value().notes[0].find("Latin-1"), std::string::npos);
}

TEST(BvhQuirks, DuplicateNamesAreNumberedAroundNamesOfTheFile) {
  const std::string text =
      "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 1 Xposition\n"
      "JOINT b { OFFSET 1 0 0 JOINT b { OFFSET 1 0 0 } }\n"
      "JOINT b#2 { OFFSET 1 0 0 }\nJOINT b { OFFSET 1 0 0 }\nJOINT a { OFFSET 1 0 0 } }\n"
      "MOTION Frames: 1 Frame Time: 0.1\n5\n";
  const auto clip = parseBvh(text, "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  const Skeleton& skeleton = clip.value().skeleton;
  const char* const expected[] = {"a", "b", "b#3", "b#2", "b#4", "a#2"};
  ASSERT_EQ(skeleton.numJoints(), 6);
  for (JointId j = 0; j < 6; ++j) EXPECT_EQ(skeleton.name(j), expected[j]);
  EXPECT_EQ(clip.value().notes.size(), 4u);  // three renamed, and joints without channels
}

TEST(BvhQuirks, NotesAreBoundedAndSaySo) {
  std::string text = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 1 Xposition\n";
  for (int i = 0; i < 100; ++i) text += "JOINT a { OFFSET 0 0 1 }\n";
  const auto clip = parseBvh(text + "} MOTION Frames: 1 Frame Time: 1 7", "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  ASSERT_EQ(clip.value().notes.size(), kMaxClipNotes);
  EXPECT_EQ(clip.value().notes.back(), "70 more notes were left out");  // 101 in all, 31 shown
}

TEST(BvhQuirks, SingleFrame) {
  const auto clip = parseBvh(
      edited(edited(plainBvh(), "4 5 6 -10 -20 -30 -40 -50 -60\n", ""), "Frames: 2", "Frames: 1"),
      "t");
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  EXPECT_EQ(clip.value().frames.size(), 1u);
  EXPECT_EQ(clip.value().durationS(), 0.0);
}

}  // namespace
}  // namespace foretouch
