// tests/bench/leaf_test.cpp: the figures of `bench leaf` on made-up timings, and the program.
#include "bench/leaf.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/generated_queries.h"

namespace foretouch::tools {
namespace {

TimedSet hundred(const std::string& name, const std::string& kind) {
  TimedSet set{name, kind, {}};
  for (int i = 1; i <= 100; ++i) {  // 1 to 100 us; the first ninety by the filter
    TimedLeaf leaf;
    leaf.us = i;
    leaf.stage = i <= 90 ? LeafStage::Filter : LeafStage::Exact;
    leaf.truth = leaf.hits = true;
    set.leaves.push_back(leaf);
  }
  return set;
}

TEST(GroupsOf, TakesMeanMedianRankAndStages) {
  const auto groups = groupsOf(hundred("set", "edge-edge"));
  ASSERT_EQ(groups.size(), 1u);
  const LeafGroup& g = groups[0];
  EXPECT_TRUE(g.positive);
  EXPECT_EQ(g.time.meanUs, 50.5);
  EXPECT_EQ(g.time.medianUs, 50.0);
  EXPECT_EQ(g.time.p99Us, 99.0);
  EXPECT_EQ(g.time.maxUs, 100.0);
  EXPECT_EQ(g.decided[0], 90u);
  EXPECT_EQ(g.decidedMeanUs[0], 45.5);
  EXPECT_EQ(g.decided[1], 10u);
  EXPECT_EQ(g.decidedMeanUs[1], 95.5);
}

TEST(GroupsOf, TellsFalseNegativesFromFalsePositives) {
  TimedSet set = hundred("set", "edge-edge");
  set.leaves[0].hits = false;                         // meets, but missed
  set.leaves[1].truth = set.leaves[2].truth = false;  // two that miss, reported as hits
  const auto groups = groupsOf(set);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].falseNegatives, 1u);
  EXPECT_EQ(groups[0].falsePositives, 0u);
  EXPECT_EQ(groups[1].falseNegatives, 0u);
  EXPECT_EQ(groups[1].falsePositives, 2u);
  LeafBench bench;
  bench.sets = {set};
  EXPECT_EQ(wrongAnswers(bench), 3u);
}

TEST(LeafGroups, JoinsHandcraftedAndAll) {
  LeafBench bench;
  bench.sets = {hundred("erleben-a", "edge-edge"), hundred("erleben-b", "vertex-face"),
                hundred("other", "edge-edge")};
  TimedSet generated = hundred("generated", "edge-edge");
  for (TimedLeaf& leaf : generated.leaves) leaf.truth.reset();
  bench.sets.push_back(generated);
  std::size_t handcrafted = 0, all = 0;
  for (const LeafGroup& g : leafGroups(bench)) {
    if (g.kind == "both" && g.name == "handcrafted") handcrafted = g.count;
    if (g.kind == "both" && g.name == "all") all = g.count;
    EXPECT_EQ(g.labelled, g.name != "generated");
  }
  EXPECT_EQ(handcrafted, 200u);
  EXPECT_EQ(all, 300u);
}

TEST(LeafJson, HoldsTheGroups) {
  LeafBench bench;
  bench.sets = {hundred("set\x1b", "edge-edge")};
  bench.repeat = 3;
  const auto json = nlohmann::json::parse(leafJson(bench));
  EXPECT_EQ(json["repeat"], 3);
  EXPECT_EQ(json["groups"][0]["count"], 100);
  EXPECT_EQ(json["groups"][0]["false_negatives"], 0);
  EXPECT_EQ(json["groups"][0]["stages"]["exact"]["count"], 10);
}

TEST(TimeLeaves, AsksEveryQueryOnceAPass) {
  std::vector<int> asked(7, 0);
  const auto leaves = timeLeaves(7, 3, [&](std::size_t i) {
    ++asked[i];
    LeafAnswer a;
    a.hits = i % 2 == 0;
    return a;
  });
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(asked[i], 3);
    EXPECT_EQ(leaves[i].hits, i % 2 == 0);
    EXPECT_GE(leaves[i].us, 0.0);
  }
}

TEST(GeneratedQueries, MeetAndMissAndRepeat) {
  for (const QueryKind kind : {QueryKind::VertexFace, QueryKind::EdgeEdge}) {
    const auto queries = generatedQueries(kind, 1000, 3), again = generatedQueries(kind, 1000, 3);
    int hits = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      hits += answer(kind, queries[i]).hits ? 1 : 0;
      EXPECT_EQ(queries[i].points[2].to, again[i].points[2].to);
    }
    EXPECT_GT(hits, 300) << toString(kind);
    EXPECT_LT(hits, 700) << toString(kind);
  }
  const auto pairs = generatedRigidPairs(300, 3);
  int hits = 0;
  for (const RigidPair& p : pairs) {
    EXPECT_GE(p.motion.q0.dot(p.motion.q1), 0.0);
    hits += rigidTrianglePair(p.motion, p.moving_L, p.fixed_W, 1e-3).leaf.hits ? 1 : 0;
  }
  EXPECT_GT(hits, 30);
  EXPECT_LT(hits, 270);
}

}  // namespace
}  // namespace foretouch::tools
