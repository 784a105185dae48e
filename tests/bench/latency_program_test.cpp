// tests/bench/latency_program_test.cpp: `foretouch-bench latency`, `scaling`, `report` and
// `instructions` as a user runs them. Shapes and invariants; no time is judged.
#include <algorithm>
#include <sstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"
#include "tests/tools/small_world.h"

namespace foretouch::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class BenchProgram : public testing::Test {
 protected:
  BenchProgram() {
    world.folder.write("way.bvh", clipAlongX({-1.0, -0.9, -0.12, 0.4, 0.5, 0.9, 1.2}));
  }

  [[nodiscard]] Words bench(const char* kind, const Words& more) const {
    const TempFolder& folder = world.folder;
    Words words = {
        kind,       "--scene",         folder / "wall.obj", "--avatar", folder / "man.json",
        "--motion", folder / "way.bvh"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  [[nodiscard]] Json json(const char* name) const {
    return Json::parse(contentOf(world.folder / name));
  }
  [[nodiscard]] static Json table(const Json& report, const std::string& name) {
    for (const Json& table : report["tables"]) {
      if (table["name"] == name) return table["rows"];
    }
    ADD_FAILURE() << "no table " << name;
    return Json::array();
  }

  SmallWorld world;
};

// What `foretouch replay` once had, and what it says of where that went.
TEST_F(BenchProgram, LatencyComparesTheReferenceRoomsWays) {
  const auto run = [&](const Words& more) {
    Words words =
        bench("latency", {"--place", "0,0,0", "--rate", "5", "--simd", "widest", "--repeat", "1",
                          "--cold-mb", "1", "--json", world.folder / "way.json"});
    words.insert(words.end(), more.begin(), more.end());
    return runBench(words);
  };
  const Ended ended = run({"--fidelity", "exact", "--surface-triangles", "2000", "--leaves",
                           "cubics", "--culler", "point-query", "--descent", "by-need"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string report = contentOf(world.folder / "way.json");
  for (const char* way : {"descent by need", "by cubics", "culled by point queries"}) {
    EXPECT_NE(report.find(way), std::string::npos) << way;
  }
  for (const auto& [words, why] : std::vector<std::pair<Words, const char*>>{
           {{"--leaves", "roots"}, "--leaves: expected advancement or cubics, found 'roots'"},
           {{"--culler", "bvh"}, "--culler: expected flat or point-query, found 'bvh'"},
           {{"--descent", ""}, "--descent: expected straight or by-need, found ''"},
           {{"--leaves", "cubics"}, "leafMethod: expected advancement at fidelity link"},
           {{"--descent", "by-need", "--fidelity", "limb"},
            "descent: expected straight at fidelity limb"}}) {
    const Ended refused = run(words);
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.err.find(why), std::string::npos) << refused.err;
  }
}

TEST_F(BenchProgram, LatencyReportsEveryRateToleranceAndCache) {
  const Words words =
      bench("latency", {"--place", "0,0,0", "--rate", "5,10", "--tolerance", "0.001,0.0001",
                        "--simd", "widest", "--repeat", "3", "--cold-mb", "1", "--json",
                        world.folder / "a.json", "--csv", world.folder / "a.csv"});
  const Ended ended = runBench(words);
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("Latency of a step"), std::string::npos);
  const Json report = json("a.json");
  EXPECT_EQ(report["format"], "foretouch-bench");
  EXPECT_EQ(
      report["command"].get<std::string>().rfind("foretouch-bench latency --scene wall.obj ", 0),
      0u);
  EXPECT_FALSE(report["machine"]["processor"].get<std::string>().empty());
  const Json rows = table(report, "latency");
  EXPECT_EQ(rows.size(), 2u * (5u + 1u));  // the second tolerance only warm
  for (const Json& row : rows) {
    EXPECT_GT(row["ray_set_us"], 0.0);
    EXPECT_LE(row["p50_us"], row["p90_us"]);
    EXPECT_LE(row["p90_us"], row["p99_us"]);
    EXPECT_LE(row["p99_us"], row["max_us"]);
    EXPECT_LE(row["mean_us"], row["max_us"]);
    const int steps = row["rate_hz"] == 10.0 ? 6 : 3;
    EXPECT_EQ(row["steps"], row["caches"] == "every repeat" ? 3 * steps : steps);
  }
  const std::string csv = contentOf(world.folder / "a.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * (3 + 6));
}

TEST_F(BenchProgram, LatencyCountsAlikeOnEveryRunAndEveryWidth) {
  Json counters[2];
  for (const int run : {0, 1}) {
    const Ended ended = runBench(
        bench("latency", {"--place", "0,0,0", "--rate", "10", "--tolerance", "0.001", "--repeat",
                          "1", "--cold-mb", "0", "--json", world.folder / "b.json"}));
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    counters[run] = table(json("b.json"), "counters");
  }
  EXPECT_EQ(counters[0], counters[1]);
  ASSERT_FALSE(counters[0].empty());
  for (const Json& row : counters[0]) EXPECT_NEAR(row["contacts"].get<double>(), 2.0 / 6.0, 1e-12);
}

TEST_F(BenchProgram, LatencyKnowsExactFidelityMoreLinksAndMoreTriangles) {
  const Ended ended = runBench(bench("latency", {"--place",
                                                 "0,0,0",
                                                 "--rate",
                                                 "10",
                                                 "--simd",
                                                 "widest",
                                                 "--repeat",
                                                 "1",
                                                 "--cold-mb",
                                                 "0",
                                                 "--fidelity",
                                                 "exact",
                                                 "--surface-triangles",
                                                 "400",
                                                 "--links",
                                                 "5",
                                                 "--triangles",
                                                 "1000",
                                                 "--json",
                                                 world.folder / "c.json"}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Json report = json("c.json");
  EXPECT_NE(report["workload"]["scene"].get<std::string>().find("1000 triangles"),
            std::string::npos);
  EXPECT_NE(report["workload"]["avatar"].get<std::string>().find("5 links"), std::string::npos);
  const Json counters = table(report, "counters");
  ASSERT_FALSE(counters.empty());
  EXPECT_GT(counters[0]["leaf_tests"], 0.0);
}

TEST_F(BenchProgram, ScalingRunsEndToEnd) {
  const Ended ended = runBench(
      bench("scaling", {"--quick", "--place", "0,0,0", "--triangles", "500", "--links", "1,4",
                        "--rate", "5", "--base-rate", "10", "--base-links", "own", "--json",
                        world.folder / "s.json", "--csv", world.folder / "s.csv"}));
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Json report = json("s.json");
  const Json rows = table(report, "scaling");
  EXPECT_EQ(rows.size(), 2u + 3u + 2u + 2u);  // a base and its values: four axes
  for (const Json& row : rows) {
    EXPECT_LE(row["p50_us"], row["p99_us"]);
    if (row["axis"] == "links" && row["value"] == 4.0) {
      EXPECT_EQ(row["links"], 4);
    }
    if (row["axis"] == "triangles" && row["value"] == 500.0) {
      EXPECT_EQ(row["triangles"], 500);
    }
  }
  const Json crowd = table(report, "crowd");
  ASSERT_EQ(crowd.size(), 2u);
  EXPECT_EQ(crowd[0]["contacts"], crowd[1]["contacts"]);
  EXPECT_EQ(crowd[0]["steps"], crowd[1]["steps"]);
}

TEST_F(BenchProgram, ReportAndInstructionsReadWhatIsWritten) {
  ASSERT_EQ(runBench(bench("latency", {"--place", "0,0,0", "--rate", "10", "--repeat", "1",
                                       "--cold-mb", "0", "--json", world.folder / "d.json"}))
                .exitCode,
            0);
  const Ended report = runBench({"report", world.folder / "d.json", world.folder / "d.json"});
  EXPECT_EQ(report.exitCode, 0) << report.err;
  const std::string title = "Latency of a step: ";
  EXPECT_EQ(report.out.rfind(title, 0), 0u);
  EXPECT_NE(report.out.find(title, 1), std::string::npos);
  world.folder.write("callgrind.out", "events: Ir\ntotals: 12000\n");
  Words words = {
      "instructions",          "--callgrind", world.folder / "callgrind.out", "--latency",
      world.folder / "d.json", "--recorded",  world.folder / "record.json"};
  EXPECT_EQ(runBench(words).exitCode, 2);  // nothing is recorded yet
  words.push_back("--record");
  EXPECT_EQ(runBench(words).exitCode, 0);
  words.pop_back();
  const Ended moved = runBench(words);
  EXPECT_EQ(moved.exitCode, 0) << moved.err;
  EXPECT_NE(moved.out.find("instructions      2000.00  2000.00     0.00"), std::string::npos)
      << moved.out;
}

TEST_F(BenchProgram, RefusesBadUse) {
  const auto names = world.folder.names();
  for (const Words& more : std::vector<Words>{{"--rate", "0"},
                                              {"--rate", "5,"},
                                              {"--rate", "100"},
                                              {"--tolerance", "nan"},
                                              {"--simd", "mmx"},
                                              {"--links", "0"},
                                              {"--links", "5000"},
                                              {"--triangles", "1e6"},
                                              {"--cold-mb", "-1"},
                                              {"--steps", "0"},
                                              {"--repeat", "0"},
                                              {"--place", "0,0"},
                                              {"--fidelity", "skinned"},
                                              {"--processor", "-3"},
                                              {"--processor", "4000"},
                                              {"--scene", "absent.obj"},
                                              {"extra"},
                                              {"--place", "0,0,0", "--rate", "10", "--repeat", "1",
                                               "--json", world.folder / "no/a.json"}}) {
    Words words = {"latency", "--motion", world.folder / "way.bvh"};
    if (more.front() != "--scene") {
      words.insert(words.end(), {"--scene", world.folder / "wall.obj"});
    }
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = runBench(words);
    EXPECT_EQ(ended.exitCode, 2) << more.front() << ": " << ended.err;
    EXPECT_EQ(ended.out, "") << more.front();
    EXPECT_EQ(ended.err.rfind("foretouch: ", 0), 0u) << ended.err;
  }
  EXPECT_EQ(runBench(bench("scaling", {"--threads", "0"})).exitCode, 2);
  EXPECT_EQ(runBench(bench("scaling", {"--avatars", "x"})).exitCode, 2);
  EXPECT_EQ(runBench({"report"}).exitCode, 2);
  EXPECT_EQ(runBench({"report", world.folder / "wall.obj"}).exitCode, 2);
  EXPECT_EQ(world.folder.names(), names);
}

}  // namespace
}  // namespace foretouch::test
