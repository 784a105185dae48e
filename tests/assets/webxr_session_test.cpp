// Sessions of WebXR in iwer's format, made by hand in its own dialect.
#include "assets/clip/webxr_session.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/humanoid_rest.h"
#include "assets/clip/clip_file.h"
#include "tests/support/holds.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

const std::vector<std::string> kJoints{"wrist",
                                       "thumb-metacarpal",
                                       "thumb-phalanx-proximal",
                                       "thumb-phalanx-distal",
                                       "thumb-tip",
                                       "index-finger-metacarpal",
                                       "index-finger-phalanx-proximal",
                                       "index-finger-phalanx-intermediate",
                                       "index-finger-phalanx-distal",
                                       "index-finger-tip"};

std::string schema() {
  std::string joints;
  for (const std::string& joint : kJoints) joints += (joints.empty() ? "\"" : ",\"") + joint + "\"";
  return "[[0,{\"handedness\":\"left\",\"targetRayMode\":\"tracked-pointer\",\"profiles\":[],"
         "\"hasGrip\":true,\"hasHand\":true,\"hasGamepad\":false,\"jointSequence\":[" +
         joints +
         "]}],[1,{\"handedness\":\"right\",\"hasGrip\":true,\"hasHand\":false,\"hasGamepad\":true,"
         "\"mapping\":\"xr-standard\",\"numButtons\":1,\"numAxes\":2}]]";
}

/// Joints 2 cm apart along -z of the target ray, which is turned by 90 degrees about y.
std::string hand(double x) {
  std::string numbers;
  for (std::size_t j = 0; j < kJoints.size(); ++j) {
    numbers += (j == 0 ? "" : ",") + std::string("0,0,") +
               std::to_string(-0.02 * static_cast<double>(j)) + ",0,0,0,1,0.01";
  }
  const std::string at = std::to_string(x);
  return "[0," + at + ",1,0,0,0.707,0,0.707,[" + at + ",1,0,0,0,0,1],[" + numbers + "]]";
}

std::string frame(double ms, const std::string& inputs) {
  return "[" + std::to_string(ms) + ",0,1.7,0,0,0,0,1" + (inputs.empty() ? "" : "," + inputs) + "]";
}

const std::string kController = "[1,0.5,1,0,0,0,0,1,[0.5,1.1,0,0,0,0,1],[[0,0,0],0,0]]";

std::string session(const std::vector<std::string>& frames) {
  std::string all;
  for (const std::string& each : frames) all += (all.empty() ? "" : ",") + each;
  return "{\"schema\":" + schema() + ",\"frames\":[" + all + "]}";
}

std::string sample() {
  return session({frame(1000.0, hand(0.0) + "," + kController),
                  frame(1010.0, hand(0.1) + "," + kController), frame(1030.0, kController),
                  frame(1040.0, hand(0.4) + "," + kController)});
}

TEST(WebXrSession, PutsJointsWhereTheRecorderSawThem) {
  const auto read = parseWebXrSession(sample(), "s.json", 100.0);
  ASSERT_TRUE(read.ok()) << describe(read.error());
  const Clip& clip = read.value();
  ASSERT_EQ(clip.frames.size(), 5u);  // 0 to 40 ms
  EXPECT_EQ(clip.skeleton.numJoints(), 12);
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(clip.skeleton.find(name).value());
  };
  EXPECT_EQ(clip.skeleton.parent(static_cast<JointId>(at("left index-finger-tip"))),
            static_cast<JointId>(at("left index-finger-phalanx-distal")));
  EXPECT_EQ(clip.skeleton.parent(static_cast<JointId>(at("left thumb-phalanx-distal"))),
            static_cast<JointId>(at("left thumb-phalanx-proximal")));
  EXPECT_EQ(clip.skeleton.parent(static_cast<JointId>(at("left index-finger-metacarpal"))),
            static_cast<JointId>(at("left wrist")));
  // Turned by 90 degrees about y, -z is -x; held at 0.1 in the frame without it, then halfway.
  const double expected[5] = {0.0, 0.1, 0.1, 0.1, 0.4};
  for (std::size_t f = 0; f < 5; ++f) {
    const auto places = placesIn(clip.skeleton, clip.frames[f]);
    EXPECT_LT((places[at("left wrist")].translation - Vector3d(expected[f], 1, 0)).norm(), 1e-9)
        << f;
    EXPECT_LT((places[at("left index-finger-tip")].translation - Vector3d(expected[f] - 0.18, 1, 0))
                  .norm(),
              1e-9);
    EXPECT_LT((places[at("right grip")].translation - Vector3d(0.5, 1.1, 0)).norm(), 1e-9);
    EXPECT_LT((places[at("viewer")].translation - Vector3d(0, 1.7, 0)).norm(), 1e-9);
  }
  ASSERT_EQ(clip.notes.size(), 1u);
  EXPECT_TRUE(holds(clip.notes[0], "'left' is absent in 1 frames")) << clip.notes[0];
  // Of the hand the frames at 20 and 30 ms are made up, of nothing else.
  ASSERT_EQ(clip.gaps.size(), kJoints.size());
  for (const ClipGap& gap : clip.gaps) {
    EXPECT_EQ(clip.skeleton.name(gap.joint).rfind("left ", 0), 0u);
    EXPECT_EQ(gap.first, 2);
    EXPECT_EQ(gap.last, 3);
  }
}

TEST(WebXrSession, BeforeAnInputIsSeenAndAfterItIsLostItsFramesAreMadeUp) {
  const std::string alone = kController, both = hand(0.4) + "," + kController;
  const auto read = parseWebXrSession(
      session({frame(0, alone), frame(10, both), frame(20, both), frame(30, alone)}), "s.json",
      100.0);
  ASSERT_TRUE(read.ok()) << describe(read.error());
  const auto& gaps = read.value().gaps;
  ASSERT_EQ(gaps.size(), 2 * kJoints.size());
  EXPECT_EQ(gaps.front().first, 0);
  EXPECT_EQ(gaps.front().last, 0);
  EXPECT_EQ(gaps.back().first, 3);
  EXPECT_EQ(gaps.back().last, 3);
}

TEST(WebXrSession, TakesTheMeanRateAndTellsOfAGap) {
  const TempFolder folder;
  const std::string path = folder.write(
      "s.json",
      session({frame(0, hand(0) + "," + kController), frame(10, hand(0) + "," + kController),
               frame(20, hand(0) + "," + kController), frame(110, hand(0) + "," + kController)}));
  const auto read = readClipFile(path);
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_TRUE(read.value().isUpright);
  EXPECT_NEAR(read.value().clip.frameTimeS, 0.11 / 3.0, 1e-12);
  ASSERT_FALSE(read.value().clip.notes.empty());
  EXPECT_TRUE(holds(read.value().clip.notes[0], "there are 0.09 s between two of its frames"))
      << read.value().clip.notes[0];
  ASSERT_EQ(read.value().clip.gaps.size(), kJoints.size() + 2);  // of every joint
  for (const ClipGap& gap : read.value().clip.gaps) {
    EXPECT_EQ(gap.first, 1);
    EXPECT_EQ(gap.last, 2);
  }
}

TEST(WebXrSession, NamesWhatIsWrong) {
  const std::string one = frame(0, hand(0) + "," + kController),
                    two = frame(10, hand(0) + "," + kController);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{\n\"schema\": [", "s.json:2: expected JSON"},
      {"[]", "expected a session of iwer's recorder"},
      {"{\"schema\":[],\"frames\":3}", "expected a session of iwer's recorder"},
      {session({one}), "expected at least two frames"},
      {session({one, one}), "frame 1: expected a time after that of the frame before"},
      {session({one, frame(10, "[7,0,0,0,0,0,0,1]")}), "frame 1: expected an input of the schema"},
      {session({one, frame(10, "[1,0,0,0,0,0,0,1]")}),
       "frame 1: expected a place of seven numbers"},
      {session({one, frame(10, "[1,0,0,0,0,0,0,0.9,[0,0,0,0,0,0,1]]")}),
       "frame 1: expected a unit quaternion"},
      {session({one, frame(10, "[0,0,0,0,0,0,0,1,[0,0,0,0,0,0,1],[0,0]]")}),
       "frame 1: expected eight numbers for each joint of a hand"},
      {session({frame(0, kController), frame(10, kController)}),
       "joint 'left wrist' is in no frame"},
      {"{\"schema\":[[0,{\"hasHand\":true,\"jointSequence\":[\"thumb-tip\"]}]],\"frames\":[]}",
       "expected a 'jointSequence' that begins with 'wrist'"},
      {"{\"schema\":[[0,{}],[0,{}]],\"frames\":[]}", "two inputs have one number"},
      {"{\"frames\":[" + one + "],\"schema\":" + schema() + "}",
       "expected 'schema' before 'frames'"},
      {"{\"schema\":" + schema() + ",\"schema\":" + schema() + ",\"frames\":[]}",
       "expected one 'schema', found two"},
      {"{\"schema\":3,\"frames\":[]}", "expected a session of iwer's recorder"},
      {"{\"schema\":" + schema() + "}", "expected a session of iwer's recorder"},
      {session({"3"}), "frame 0: expected a time and places"},
      {session({"{}", one}), "frame 0: expected a time and places"},
  };
  for (const auto& [text, expected] : cases) {
    const auto read = parseWebXrSession(text, "s.json");
    ASSERT_FALSE(read.ok()) << expected;
    EXPECT_TRUE(holds(describe(read.error()), expected)) << describe(read.error());
  }
  const std::string whole = sample();
  for (std::size_t n = 0; n < whole.size(); ++n) {
    EXPECT_FALSE(parseWebXrSession(whole.substr(0, n), "s.json").ok());
  }
}

}  // namespace
}  // namespace foretouch::test
