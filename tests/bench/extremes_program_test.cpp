// tests/bench/extremes_program_test.cpp: `foretouch-bench extremes` as a user runs it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

TEST(BenchExtremes, RunsFamiliesAndWritesWhatItFound) {
  const TempFolder folder;
  const Ended ended = runBench({"extremes", "--only", "touching,refused", "--cases", "13", "--json",
                                folder / "extremes.json", "--csv", folder / "extremes.csv",
                                "--dump", folder / "cases.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("touching"), std::string::npos) << ended.out;
  const auto json = nlohmann::json::parse(contentOf(folder / "extremes.json"));
  EXPECT_EQ(json["kind"], "extremes");
  const std::string csv = contentOf(folder / "extremes.csv");
  EXPECT_EQ(csv.rfind("family,cases,refused,queries,contacts,", 0), 0u) << csv;
  const auto cases = nlohmann::json::parse(contentOf(folder / "cases.json"));
  EXPECT_EQ(cases["format"], "foretouch-extremes");
  ASSERT_GT(cases["cases"].size(), 0u);
  EXPECT_EQ(cases["cases"][0]["family"], "touching");
}

TEST(BenchExtremes, ListsItsFamilies) {
  const Ended ended = runBench({"extremes", "--list"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* const name : {"far ", "slivers ", "denormals ", "half-turn ", "refused "}) {
    EXPECT_NE(ended.out.find(name), std::string::npos) << name << '\n' << ended.out;
  }
}

TEST(BenchExtremes, EndsWithTwoOnBadUse) {
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--cases", "0"},
           {"--cases", "many"},
           {"--seed", "-1"},
           {"--coincident", "0"},
           {"--only", "extremer"},
           {"--only", "far,"},
           {"--only", "refused", "--cases", "1", "--json", "/nowhere/at/all.json"}}) {
    std::vector<std::string> arguments{"extremes"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runBench(arguments);
    EXPECT_EQ(ended.exitCode, 2) << more.front() << ' ' << more.back() << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
