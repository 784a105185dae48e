// tests/bench/peers_program_test.cpp: `foretouch-bench peers` as a user runs it.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/peers.h"
#include "tests/tools/program_run.h"

namespace foretouch::test {
namespace {

TEST(BenchPeers, ComparesInTheBundledRoom) {
  if (!tools::hasPeers()) GTEST_SKIP() << "built without FCL and Bullet";
  const TempFolder folder;
  const Ended ended = runBench({"peers", "--motions", "4", "--triangles", "1", "--rounds", "1",
                                "--json", folder / "peers.json", "--csv", folder / "peers.csv"});
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
  for (const char* const word : {"S1: ", "S2: ", "S5: ", "FCL", "Bullet", "missed", "room.obj"}) {
    EXPECT_NE(ended.out.find(word), std::string::npos) << word << '\n' << ended.out;
  }
  const auto json = nlohmann::json::parse(contentOf(folder / "peers.json"));
  EXPECT_EQ(json["kind"], "peers");
  const std::string csv = contentOf(folder / "peers.csv");
  EXPECT_EQ(csv.rfind("set,motion,solver,us,touches,toi,true_touches,true_toi\n", 0), 0u);
}

TEST(BenchPeers, SaysPlainlyWhatItWasBuiltWithout) {
  if (tools::hasPeers()) GTEST_SKIP() << "built with FCL and Bullet";
  const Ended ended = runBench({"peers", "--motions", "4"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("libfcl-dev and libbullet-dev"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
}

TEST(BenchPeers, EndsWithTwoOnBadUse) {
  const TempFolder folder;
  folder.write("speck.obj", "v 0 0 0\nv 0.00001 0 0\nv 0 0.00001 0\nf 1 2 3\n");
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"--motions", "0"},
           {"--motions", "many"},
           {"--rounds", "0"},
           {"--peer-rounds", "-1"},
           {"--sets", "S9"},
           {"--triangles", "99999999999"},
           {"--up", "x"},
           {"--scene-scale", "0"},
           {"--scene", folder / "absent.obj"},
           {"--scene", folder / "speck.obj", "--motions", "2", "--triangles", "1"},
           {"--scene", folder / "speck.obj", "--json", folder / "speck.obj"}}) {
    std::vector<std::string> arguments{"peers"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = runBench(arguments);
    EXPECT_EQ(ended.exitCode, 2) << more.front() << ' ' << more.back() << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
    EXPECT_EQ(folder.names(), std::set<std::string>{"speck.obj"});
  }
}

}  // namespace
}  // namespace foretouch::test
