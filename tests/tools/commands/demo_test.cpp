// tests/tools/commands/demo_test.cpp: `foretouch demo` on an example of the tests' own.
#include <gtest/gtest.h>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

TEST(Demo, ReplaysTheExampleAndSaysInWordsWhatADiscreteCheckMisses) {
  const SmallWorld world;
  world.folder.write("room.obj", kWallObj);
  world.folder.write("dancer.avatar.json", kManAvatar);
  world.folder.write("dancer.bvh", clipThroughWall());
  const std::string out = world.folder / "demo.jsonl";
  const Ended ended =
      runForetouch({"demo", "--output", out}, {"FORETOUCH_EXAMPLES=" + (world.folder / ".")});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* part :
       {"triangles", "without area", "links", "volume of all LSS", "found 2 first contacts",
        "would have missed 2", "at step 1 'Hips' met 'wall' at t=0.",
        "a discrete check at the two poses saw nothing", "rigid model", "occlusion rays"}) {
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  }
  EXPECT_EQ(contentOf(out).rfind("{\"format\":\"foretouch-results\"", 0), 0u);
}

TEST(Demo, SaysWhereItLookedForTheExample) {
  const TempFolder folder;
  const Ended ended = runForetouch({"demo", "--output", folder / "out.jsonl"},
                                   {"FORETOUCH_EXAMPLES=" + (folder / "nowhere")});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find(folder / "nowhere"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("FORETOUCH_EXAMPLES"), std::string::npos) << ended.err;
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace foretouch::test
