// `foretouch-verify` as a program: what it proves, what it refuses, and what "--whole" asks
// besides.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

/// Poses of all links, at x = 0 and at x = 1.
const std::string kThere = "0 0 0 1 0 0 0\n0 0 1 1 0 0 0\n0 0 0 1 0 0 0\n";
const std::string kHere = "1 0 0 1 0 0 0\n1 0 1 1 0 0 0\n1 0 0 1 0 0 0\n";
const std::string kSteps =
    "foretouch-steps 1\nstep 0\n" + kThere + kHere + "step 1\n" + kHere + kThere;

/// Two spheres side by side that run from x = 0 to x = 1, and back again, before a wall at x = 9,
/// and a link without LSS, of which nothing needs to be claimed.
class VerifyProgram : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene", "v 9 -5 -5\nv 9 5 -5\nv 9 0 9\nf 1 2 3\n");
    const std::string rest = R"(","parent":null,"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},)";
    folder_.write("avatar", R"({"format":"foretouch-avatar","links":[{"name":"a)" + rest +
                                R"({"name":"b)" + rest +
                                R"({"name":"c","parent":null,"lss":[]}]})");
    folder_.write("steps", kSteps);
  }
  [[nodiscard]] std::vector<std::string> files() const {
    return {folder_ / "scene", folder_ / "avatar", folder_ / "steps", folder_ / "proof"};
  }
  [[nodiscard]] Ended verified(const std::string& claims, const std::string& more = "") const {
    folder_.write("proof", "foretouch-certificate 1\n" + claims + "end\n");
    std::vector<std::string> arguments = files();
    if (!more.empty()) arguments.push_back(more);
    return runVerify(arguments);
  }
  /// What it refuses, and how.
  void expectRefused(const Ended& ended, int exitCode, const std::string& why) const {
    EXPECT_EQ(ended.exitCode, exitCode) << ended.out << ended.err;
    EXPECT_TRUE(holds(exitCode == 1 ? ended.out : ended.err, why)) << ended.out << ended.err;
  }

  TempFolder folder_;
};

std::string claimOf(int step, const std::vector<int>& links) {
  std::string text = "step " + std::to_string(step) + "\n";
  for (const int link : links) text += "link " + std::to_string(link) + "\nlss 0\nspan 0 0\n";
  return text;
}

TEST_F(VerifyProgram, ProvesWhatIsClaimed) {
  for (const std::string more : {"", "--whole"}) {
    const Ended ended = verified(claimOf(1, {0, 1}) + claimOf(0, {1, 0}), more);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_TRUE(holds(ended.out, "proven: 4 links on 2 steps touch nothing: 4 LSS, 4 spans"));
  }
  expectRefused(verified(claimOf(7, {0})), 1, "step 7: is none of the steps");
  expectRefused(verified(claimOf(0, {3})), 1, "step 0: the avatar has no such link");
  expectRefused(verified(""), 1, "it claims nothing");
}

TEST_F(VerifyProgram, AskedForTheWholeRefusesWhatLeavesALinkOut) {
  const std::string other = claimOf(1, {0, 1});
  for (const int link : {0, 1}) {
    EXPECT_EQ(verified(claimOf(0, {link}) + other).exitCode, 0);
    expectRefused(verified(claimOf(0, {link}) + other, "--whole"), 1, "only 1 of 2 steps");
  }
  EXPECT_EQ(verified(other).exitCode, 0);
  expectRefused(verified(other, "--whole"), 1, "only 1 of 2 steps");
}

TEST_F(VerifyProgram, SaysWhatItCannotRead) {
  ASSERT_EQ(verified(claimOf(0, {0})).exitCode, 0);
  expectRefused(verified(claimOf(0, {0}), "--all"), 2, "expected SCENE AVATAR STEPS|EDGES");
  expectRefused(runVerify({folder_ / "scene", folder_ / "avatar", folder_ / "steps"}), 2,
                "expected SCENE AVATAR STEPS|EDGES");
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::string> paths = files();
    paths[i] = folder_ / "nothing";
    expectRefused(runVerify(paths), 2, "nothing: expected a file");
    paths[i] = folder_.write("other", "something else\n");
    expectRefused(runVerify(paths), 2, "other:");
  }
  folder_.write("steps", kSteps + "step 1\n" + kHere + kThere);
  expectRefused(runVerify(files()), 2, "step 1 is there twice");
}

}  // namespace
}  // namespace foretouch::test
