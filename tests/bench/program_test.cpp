// tests/bench/program_test.cpp: `foretouch-bench leaf` as a user runs it.
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/shared_data.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

const std::string kHit =
    "1,4,1,4,1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
    "1,4,1,4,-1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";

TEST(BenchLeaf, RunsWithoutData) {
  const TempFolder folder;
  const Ended ended = runBench({"leaf", "--generated", "50", "--json", folder / "leaf.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("seed 1"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("rigid pair"), std::string::npos) << ended.out;
  const auto json = nlohmann::json::parse(contentOf(folder / "leaf.json"));
  EXPECT_TRUE(json["groups"][0]["false_negatives"].is_null());
}

TEST(BenchLeaf, SaysNoWhereAnAnswerIsNotItsLabel) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "set/vertex-face");
  folder.write("set/vertex-face/right.csv", kHit);
  EXPECT_EQ(runBench({"leaf", "--queries", folder.path()}).exitCode, 0);
  std::string lie = kHit;
  for (std::size_t i = 0; i + 1 < lie.size(); ++i) {
    if (lie[i + 1] == '\n') lie[i] = '0';
  }
  folder.write("set/vertex-face/lie.csv", lie);
  const Ended ended = runBench({"leaf", "--queries", folder.path()});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_EQ(ended.err, "foretouch: 1 answers differ from their labels\n");
}

TEST(BenchLeaf, EndsWithTwoOnBadUse) {
  const TempFolder folder;
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"leaf"},
           {"leaf", "--generated", "-1"},
           {"leaf", "--generated", "99999999999"},
           {"leaf", "--generated", "1", "--repeat", "0"},
           {"leaf", "--generated", "1", "--json", folder / "no/leaf.json"},
           {"leaf", "--queries", folder / "absent"},
           {"leaf", "--queries", folder.path()}}) {
    const Ended ended = runBench(arguments);
    EXPECT_EQ(ended.exitCode, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
    EXPECT_TRUE(folder.names().empty());
  }
}

TEST(BenchLeaf, AnswersThePublicQueriesRight) {
  FORETOUCH_REQUIRE_SHARED(queries, "ccd-queries/sample-queries");
  const Ended ended = runBench({"leaf", "--queries", *queries, "--repeat", "1"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err << ended.out;
  EXPECT_NE(ended.out.find("handcrafted"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::test
