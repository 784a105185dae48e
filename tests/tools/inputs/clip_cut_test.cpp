#include "tools/inputs/clip_cut.h"

#include <string>

#include <gtest/gtest.h>

#include "assets/bvh/bvh_reader.h"
#include "tests/tools/inputs/arms_bvh.h"
#include "tools/inputs/t_pose.h"

namespace foretouch::tools {
namespace {

Clip armsClip(int tFrames, int frames) {
  return parseBvh(test::armsBvh(tFrames, frames), "arms.bvh").value();
}

Result<FrameRange> cutOf(const Clip& clip, const char* from, const char* to, bool skips = false) {
  ClipRequest request;
  if (*from != '\0') request.cut.from = clipInstantFrom(from).value();
  if (*to != '\0') request.cut.to = clipInstantFrom(to).value();
  request.cut.skipsTPose = skips;
  return framesOf(request, clip, false);
}

TEST(ClipCut, TakesSecondsAndFrames) {
  const Clip clip = armsClip(0, 101);
  EXPECT_EQ(cutOf(clip, "", "").value().count(), 101u);
  const FrameRange bySeconds = cutOf(clip, "0.2", "0.5").value();
  EXPECT_EQ(bySeconds.first, 20);
  EXPECT_EQ(bySeconds.last, 50);
  const FrameRange byFrames = cutOf(clip, "7f", "9f").value();
  EXPECT_EQ(byFrames.first, 7);
  EXPECT_EQ(byFrames.last, 9);
}

TEST(ClipCut, RefusesWhatIsNotInTheClip) {
  const Clip clip = armsClip(0, 101);
  EXPECT_EQ(cutOf(clip, "1.2", "").error().message,
            "expected an instant of the clip, which ends at 1 s (frame 100), found 1.2 s");
  EXPECT_EQ(cutOf(clip, "", "101f").error().file, "--to");
  EXPECT_FALSE(cutOf(clip, "0.5", "0.5").ok());
  EXPECT_FALSE(cutOf(clip, "0.5", "0.2").ok());
  for (const char* const text : {"", "f", "-1", "1.5f", "x", "nan", "1e400"}) {
    EXPECT_FALSE(clipInstantFrom(text).ok()) << text;
  }
}

TEST(ClipCut, LeavesOutTheTPoseThatAClipBeginsWith) {
  for (const int tFrames : {0, 1, 40}) {
    const Clip clip = armsClip(tFrames, 101);
    EXPECT_EQ(tPoseFramesOf(clip, false), tFrames);
    const FrameRange range = cutOf(clip, "", "", true).value();
    EXPECT_EQ(range.first, tFrames);
    EXPECT_EQ(range.tPose, tFrames);
  }
  EXPECT_EQ(cutOf(armsClip(101, 101), "", "", true).error().message,
            "all 101 frames of the clip are a T-pose");
  EXPECT_EQ(tPoseFramesOf(armsClip(40, 101), true), 40) << "held out along x, level either way";
}

}  // namespace
}  // namespace foretouch::tools
