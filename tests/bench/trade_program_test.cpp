// tests/bench/trade_program_test.cpp: `foretouch-bench trade` and `tune` as a user runs them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

/// The small world's man walks through the wall again and again.
class TradeProgram : public ::testing::Test {
 protected:
  TradeProgram() {
    world_.folder.write("there.bvh", clipAlongX({-0.75, -0.25, 0.25, 0.75, 0.3, -0.4, -0.8, 0.1}));
    world_.folder.write("slow.bvh",
                        clipAlongX({-0.5, -0.45, -0.3, -0.2, -0.15, -0.12, -0.11, 0.0}));
  }
  [[nodiscard]] std::string at(const char* name) const { return world_.folder / name; }
  [[nodiscard]] Ended tune(const std::vector<std::string>& more, const char* clip = "there.bvh") {
    std::vector<std::string> arguments = {"tune",         "--scene",  at("wall.obj"),
                                          "--motion",     at(clip),   "--avatar",
                                          at("man.json"), "--passes", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runBench(arguments);
  }
  SmallWorld world_;
};

TEST_F(TradeProgram, WritesEverythingItMeasured) {
  const Ended ended = runBench({"trade",
                                "--quick",
                                "--scenes",
                                at("wall.obj"),
                                "--clips",
                                at("there.bvh") + "," + at("slow.bvh"),
                                "--rate",
                                "10,99",
                                "--tolerance",
                                "0.001",
                                "--floor",
                                "-1",
                                "--lift",
                                "0.5",
                                "--json",
                                at("trade.json"),
                                "--csv",
                                at("trade.csv"),
                                "--markdown",
                                at("trade.md"),
                                "--surface-triangles",
                                "200"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("there.bvh holds no steps at 99 Hz"), std::string::npos);
  EXPECT_NE(ended.out.find("0 answers differed"), std::string::npos);
  const auto json = nlohmann::json::parse(contentOf(at("trade.json")));
  EXPECT_EQ(json["kind"], "trade");
  EXPECT_NE(contentOf(at("trade.md")).find("| poses only |"), std::string::npos);
  const std::string csv = contentOf(at("trade.csv"));
  EXPECT_NE(csv.find("there.bvh,plain advancement"), std::string::npos);
  EXPECT_NE(csv.find("slow.bvh,carried certificates"), std::string::npos);
}

TEST_F(TradeProgram, RecommendsWhatHoldsWhenMeasuredAgain) {
  for (const char* const clip : {"there.bvh", "slow.bvh"}) {
    const Ended first =
        tune({"--rate", "10", "--budget-us", "100000", "--json", at("tune.json")}, clip);
    ASSERT_EQ(first.exitCode, 0) << first.err;
    EXPECT_NE(first.out.find("At 10 Hz: --fidelity link --tolerance 1e-06"), std::string::npos)
        << first.out;
    // Again, by another command: the recommended setting finds what was counted.
    const Ended again = runForetouch({"replay", "--scene", at("wall.obj"), "--motion", at(clip),
                                      "--avatar", at("man.json"), "--fidelity", "link",
                                      "--tolerance", "1e-06", "--output", at("again.jsonl")});
    ASSERT_EQ(again.exitCode, 0) << again.err;
    const std::string lines = contentOf(at("again.jsonl"));
    const std::string kContact = "\"verdict\":\"contact\"";
    std::size_t contacts = 0;
    for (std::size_t i = lines.find(kContact); i != std::string::npos;
         i = lines.find(kContact, i + 1)) {
      ++contacts;
    }
    EXPECT_GT(contacts, 0u);
    EXPECT_NE(first.out.find("nothing missed of " + std::to_string(contacts) + " contacts"),
              std::string::npos)
        << contacts << first.out;
  }
}

TEST_F(TradeProgram, RefusesNonsense) {
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--budget-us", "0"},
                                             {"--budget-us", "-3"},
                                             {"--budget-us", "soon"},
                                             {"--rate", "0"},
                                             {"--rate", "1000"},
                                             {"--passes", "0"},
                                             {"--steps", "none"},
                                             {"--place", "1,2"},
                                             {"--json", at("wall.obj")}}) {
    const Ended ended = tune(more);
    EXPECT_EQ(ended.exitCode, 2) << more[0] << " " << more[1] << ended.out;
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
  }
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--tolerance", "1e-8"},
           {"--tolerance", "0"},
           {"--scales", "1,2,3"},
           {"--clips", at("there.bvh") + ","},
           {"--rate", "x"},
           {"--markdown", at("there.bvh"), "--clips", at("there.bvh")}}) {
    std::vector<std::string> arguments = {"trade", "--quick"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runBench(arguments);
    EXPECT_EQ(ended.exitCode, 2) << more[0] << " " << more[1];
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
  }
}

}  // namespace
}  // namespace foretouch::test
