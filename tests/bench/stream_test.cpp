// The stream's benchmark: what it computes, and the program run for a moment.
#include "bench/stream.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.h"
#include "tests/tools/program_run.h"

namespace foretouch::tools {
namespace {

TEST(SlopeOf, IsThatOfALineWhateverItsOffset) {
  EXPECT_DOUBLE_EQ(slopeOf({1.0, 2.0, 4.0}, {103.0, 106.0, 112.0}), 3.0);
  EXPECT_DOUBLE_EQ(slopeOf({0.0, 1.0, 2.0}, {5.0, 5.0, 5.0}), 0.0);
  // Least squares: the residuals 1, -2, 1 are orthogonal to time and to one.
  EXPECT_NEAR(slopeOf({0.0, 1.0, 2.0}, {1.0, 0.0, 5.0}), 2.0, 1e-12);
}

TEST(SlopeOf, IsZeroWithoutTwoInstants) {
  EXPECT_EQ(slopeOf({}, {}), 0.0);
  EXPECT_EQ(slopeOf({1.0}, {7.0}), 0.0);
  EXPECT_EQ(slopeOf({1.0, 1.0}, {7.0, 9.0}), 0.0);
}

TEST(BenchStreamProgram, CountsEveryPoseOfEveryCrowd) {
  const test::TempFolder folder;
  const std::string json = folder.path() + "/stream.json";
  const test::Ended ended =
      test::runBench({"stream", "--crowds", "1x40,3x20", "--seconds", "1", "--json", json});
  if (ended.exitCode == 2 && ended.err.find("network namespace") != std::string::npos) {
    GTEST_SKIP() << "no network namespaces here";
  }
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  std::ifstream file(json);
  const auto rows = nlohmann::json::parse(file).at("tables").at(0).at("rows");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("poses"), 40);
  EXPECT_EQ(rows[1].at("poses"), 60);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("lost"), 0);
    EXPECT_EQ(row.at("gaps"), 0);
    EXPECT_GT(row.at("round_trip_p50_us"), 0.0);
    EXPECT_LE(row.at("round_trip_p50_us"), row.at("round_trip_max_us"));
  }
}

TEST(BenchStreamProgram, RefusesCrowdsThatAreNone) {
  for (const char* crowds : {"90", "0x90", "2x", "2x-1", "2x90,,1x1", "2x1e9"}) {
    const test::Ended ended = test::runBench({"stream", "--crowds", crowds, "--seconds", "1"});
    EXPECT_EQ(ended.exitCode, 2) << crowds;
    EXPECT_NE(ended.err.find("--crowds"), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::tools
