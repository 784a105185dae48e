// The program with VRM avatars, as a user would run it.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "tests/assets/vrm_writer.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

const std::string kExamples = FORETOUCH_EXAMPLE_FOLDER;

TEST(VrmProgram, MakesAnAvatarThatTheCheckAcceptsAndAClipOfOthersMoves) {
  for (const VrmVersion version : {VrmVersion::Old, VrmVersion::One}) {
    const TempFolder folder;
    const std::string body = folder.write("body.vrm", vrmSample(version).file.glb());
    const std::string avatar = folder / "body.avatar.json", clip = kExamples + "/dancer.bvh";
    const Ended made = runForetouch({"avatar", "mesh", body, "-o", avatar});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_TRUE(holds(made.err, "spring bones are not followed")) << made.err;
    EXPECT_TRUE(readAvatarFile(avatar).value().skeleton().find("leftUpperArm"));
    const Ended check = runForetouch({"avatar", "check", avatar, "--motion", clip});
    EXPECT_EQ(check.exitCode, 0) << check.err << check.out;
    EXPECT_TRUE(holds(check.err, "joints follow it by their part of the body")) << check.err;
    const Ended replay = runForetouch({"replay", kExamples + "/room.obj", avatar, clip, "--rate",
                                       "5", "--output", folder / "r.jsonl"});
    EXPECT_EQ(replay.exitCode, 0) << replay.err;
    EXPECT_TRUE(holds(contentOf(folder / "r.jsonl"), "\"leftFoot\""));
    const Ended mended = runForetouch(
        {"repair", kExamples + "/room.obj", avatar, clip, "--output", folder / "mended.bvh"});
    EXPECT_EQ(mended.exitCode, 2) << mended.err;
    EXPECT_TRUE(holds(mended.err, "joints with the names of the avatar's")) << mended.err;
  }
}

TEST(VrmProgram, LeavesOutCollidersIfAsked) {
  const TempFolder folder;
  const std::string body = folder.write("body.vrm", vrmSample(VrmVersion::Old).file.glb());
  std::vector<std::string> make{"avatar", "mesh", body, "-o", folder / "a.json"};
  const Ended with = runForetouch(make);
  ASSERT_EQ(with.exitCode, 0) << with.err;
  EXPECT_TRUE(holds(with.err, "the largest of radius 0.1")) << with.err;
  const int all = readAvatarFile(folder / "a.json").value().numLss();
  make.emplace_back("--mesh-alone");
  ASSERT_EQ(runForetouch(make).exitCode, 0);
  EXPECT_EQ(readAvatarFile(folder / "a.json").value().numLss(), all - 1);
}

TEST(VrmProgram, SetsUpAScene) {
  const TempFolder folder;
  const std::string body = folder.write("body.vrm", vrmSample(VrmVersion::One).file.glb());
  const std::string project = folder / "foretouch.toml";
  const Ended ended =
      runForetouch({"setup", kExamples + "/room.obj", body, "--yes", "-o", project});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_TRUE(readAvatarFile(folder / "body.avatar.json").ok());
}

TEST(VrmProgram, RefusesAMalformedFileByFilePlaceAndExpectation) {
  const TempFolder folder;
  VrmSample sample = vrmSample(VrmVersion::One);
  sample.extension("VRMC_vrm")["humanoid"]["humanBones"]["head"]["node"] = 9999;
  const std::string body = folder.write("body.vrm", sample.file.glb());
  const auto before = folder.names();
  const Ended ended = runForetouch({"avatar", "mesh", body, "-o", folder / "a.json"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_TRUE(holds(ended.err, "body.vrm")) << ended.err;
  EXPECT_TRUE(holds(ended.err, "humanBones.head.node: expected the number of one of")) << ended.err;
  EXPECT_EQ(folder.names(), before);
}

}  // namespace
}  // namespace foretouch::test
