// tests/bench/compare_program_test.cpp: `foretouch-bench compare` as a user runs it.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

using Words = std::vector<std::string>;

Words comparing(const SmallWorld& world, const Words& more) {
  const TempFolder& folder = world.folder;
  Words words = {"compare",           "--scene",  folder / "wall.obj", "--avatar",
                 folder / "man.json", "--motion", folder / "way.bvh"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Through the wall in one step, and away from it.
TEST(CompareProgram, CountsWhatPosesAndRigidLinksMiss) {
  const SmallWorld world;
  world.folder.write("way.bvh", clipAlongX({-0.25, 0.25, 0.75}));
  const std::string out = world.folder / "compare.json";
  const Ended ended = runBench(comparing(world, {"--json", out}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const auto report = nlohmann::json::parse(contentOf(out));
  ASSERT_EQ(report["tables"].size(), 1u);
  const auto row = report["tables"][0]["rows"][0];
  EXPECT_EQ(row["contacts"], 2);
  EXPECT_EQ(row["missed_by_poses"], 2);
  EXPECT_EQ(row["missed_by_rigid"], 0);
  EXPECT_EQ(row["false_contacts"], 0);
  EXPECT_EQ(row["undecided"], 0);
}

TEST(CompareProgram, RefusesByNameWhatCannotBeCompared) {
  const SmallWorld world;
  world.folder.write("way.bvh", clipAlongX({-0.25, 0.25}));
  for (const auto& [words, why] : std::vector<std::pair<Words, const char*>>{
           {{"--budget-us", "5"}, "--budget-us: expected none"},
           {{"--fidelity", "skinned"}, "--fidelity: expected link or exact, found 'skinned'"},
           {{"--json", world.folder / "way.bvh"}, "is an input as well"}}) {
    const Ended ended = runBench(comparing(world, words));
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
