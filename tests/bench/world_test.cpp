// tests/bench/world_test.cpp: what `foretouch-bench world` measures by: crowds, pairs that both
// move and their truth, and the program as a user runs it.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/peers/moving_pairs.h"
#include "bench/world/pairs.h"
#include "bench/world/people.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

TEST(BenchWorld, PairsBothMoveAndHalfOfThemMeet) {
  const auto pairs = tools::drawnPairs(tools::PairKind::Capsules, 40, 1),
             again = tools::drawnPairs(tools::PairKind::Capsules, 40, 1);
  int touching = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const tools::MovingPair& pair = pairs[i];
    EXPECT_EQ(pair.toi, again[i].toi);
    EXPECT_GT(tools::displacement(pair.one, 0.0, 1.0), 0.0);
    EXPECT_GT(tools::displacement(pair.other, 0.0, 1.0), 0.0);
    touching += pair.touches;
    if (!pair.touches) continue;
    EXPECT_GT(pair.toi, 0.0);
    EXPECT_LE(pair.toi, 1.0);
  }
  EXPECT_EQ(touching, 20);
}

TEST(BenchWorld, AWorldMissesNoPairAndTellsNoneTooLate) {
  for (const auto& [kind, count] :
       {std::pair{tools::PairKind::Capsules, 60}, std::pair{tools::PairKind::RingAndCapsule, 10}}) {
    const tools::JudgedTable pairs = tools::pairsTable(kind, count, 7);
    EXPECT_EQ(pairs.violations, 0u);
    ASSERT_FALSE(pairs.table.rows.empty());
    EXPECT_EQ(std::get<std::int64_t>(pairs.table.rows[0][2]), count / 2);
  }
}

TEST(BenchWorld, MeasuresByTheBundledDancer) {
  const TempFolder folder;
  const Ended ended = runBench(
      {"world", "--data", folder.path(), "--avatars", "2,5", "--pairs", "20", "--windows", "2",
       "--parts", "crowd,pairs,ticking,events,following", "--json", folder / "world.json"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("dancer.bvh"), std::string::npos) << ended.out;
  const auto json = nlohmann::json::parse(contentOf(folder / "world.json"));
  EXPECT_EQ(json["kind"], "world");
  ASSERT_EQ(json["tables"].size(), 6u);
  const auto& crowd = json["tables"][0];
  ASSERT_EQ(crowd["rows"].size(), 2u);
  EXPECT_EQ(crowd["rows"][1]["avatars"], 5);
  EXPECT_EQ(crowd["rows"][1]["all_pairs"], 10);
  EXPECT_GT(crowd["rows"][1]["answer_us"], 0.0);
  EXPECT_GE(crowd["rows"][1]["spans"], 5.0);  // everybody's own links, at least
  for (const auto& table : json["tables"]) {
    for (const auto& row : table["rows"]) EXPECT_EQ(row.size(), table["columns"].size());
  }
  EXPECT_EQ(json["tables"][3]["rows"][1]["missed"], 0);
  const auto& followed = json["tables"][4]["rows"][1];
  EXPECT_GT(followed["touches"], 0);
  for (const char* fault : {"missed", "invented", "wrong_order", "late"}) {
    EXPECT_EQ(followed[fault], 0) << fault;
  }
  const auto& costs = json["tables"][5]["rows"];
  EXPECT_GT(costs[0]["intervals"], 0);
  EXPECT_GT(costs[0]["looks"], 0.0);
  EXPECT_EQ(costs[1]["events"], 0);
}

TEST(BenchWorld, EndsWithTwoOnBadUse) {
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--parts", "crowds"},
                                             {"--avatars", "0"},
                                             {"--avatars", "2,many"},
                                             {"--pairs", "0"},
                                             {"--windows", "-1"},
                                             {"--seed", "x"}}) {
    std::vector<std::string> arguments{"world"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runBench(arguments);
    EXPECT_EQ(ended.exitCode, 2) << more[0] << ' ' << more[1];
    EXPECT_NE(ended.err.find(more[0]), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
}

}  // namespace
}  // namespace foretouch::test
