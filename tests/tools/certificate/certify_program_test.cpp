// `foretouch certify` of a clip that begins in a T-pose.
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tests/tools/inputs/arms_bvh.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

/// Hands that are held out go through the wall; hands that hang do not come near it.
TEST(CertifyProgram, LeavesOutATPoseWhenAsked) {
  const TempFolder folder;
  folder.write("wall.obj",
               "o wall\nv 0.9 -2 -2\nv 0.9 2 -2\nv 0.9 2 2\nv 0.9 -2 2\nf 1 2 3\nf 1 3 4\n");
  folder.write("arms.bvh", armsBvh(5, 12));
  const std::string man = folder / "arms.json";
  ASSERT_EQ(runForetouch({"avatar", "bvh", folder / "arms.bvh", "-o", man}).exitCode, 0);
  folder.write("hang.bvh", armsBvh(0, 7));
  const auto certify = [&](const std::string& proof, const std::vector<std::string>& more,
                           const std::string& clip = "arms.bvh") {
    std::vector<std::string> arguments{"certify", folder / "wall.obj", man, folder / clip,
                                       "-o",      folder / proof};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  };
  const Ended all = certify("all", {}), cut = certify("cut", {"--skip-t-pose"});
  ASSERT_EQ(all.exitCode, 0) << all.err;
  ASSERT_EQ(cut.exitCode, 0) << cut.err;
  EXPECT_NE(all.out.find("67 clear links on 11 steps"), std::string::npos) << all.out;
  EXPECT_NE(cut.out.find("42 clear links on 6 steps"), std::string::npos) << cut.out;
  EXPECT_NE(cut.err.find("--skip-t-pose: left out a T-pose, the first 5 frames (0.05 s)"),
            std::string::npos)
      << cut.err;
  // The proof is that of the clip without those frames, to the byte.
  ASSERT_EQ(certify("hang", {}, "hang.bvh").exitCode, 0);
  for (const std::string name : {"/steps.txt", "/certificate.txt"}) {
    EXPECT_EQ(contentOf(folder / ("cut" + name)), contentOf(folder / ("hang" + name))) << name;
  }
}

}  // namespace
}  // namespace foretouch::test
