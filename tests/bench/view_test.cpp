// The benchmark of viewers: the program run for a moment.
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

TEST(BenchViewProgram, MeasuresEachNumberOfViewers) {
  const TempFolder folder;
  const std::string json = folder.path() + "/view.json";
  const Ended ended = runBench({"view", "--crowd", "2x60", "--viewers", "1,3", "--seconds", "2",
                                "--repeat", "1", "--json", json});
  if (ended.exitCode == 2 && ended.err.find("network namespace") != std::string::npos) {
    GTEST_SKIP() << "no network namespaces here";
  }
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  std::ifstream file(json);
  const auto rows = nlohmann::json::parse(file).at("tables").at(0).at("rows");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("viewers"), "no view");
  EXPECT_EQ(rows[1].at("viewers"), "0");
  EXPECT_EQ(rows[3].at("viewers"), "3");
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("poses"), 240);
    EXPECT_EQ(row.at("lost"), 0);
    EXPECT_EQ(row.at("ended"), 0);
    EXPECT_GT(row.at("added_p50_us"), 0.0);
    const bool isWatched = row.at("viewers") == "1" || row.at("viewers") == "3";
    EXPECT_EQ(row.at("step_p50_ms") > 0.0, isWatched);
    EXPECT_EQ(row.at("contact_p99_ms") > 0.0, isWatched);
    EXPECT_EQ(row.at("kb_per_s") > 0.0, isWatched);
  }
}

TEST(BenchViewProgram, RefusesViewersThatAreNotLetIn) {
  for (const char* viewers : {"65", "0", "-1", "many", ""}) {
    const Ended ended = runBench({"view", "--viewers", viewers, "--seconds", "1"});
    EXPECT_EQ(ended.exitCode, 2) << viewers;
    EXPECT_NE(ended.err.find("--viewers"), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
