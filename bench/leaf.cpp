#include "bench/leaf.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/generated_queries.h"
#include "bench/report.h"
#include "tests/reference/rigid_query.h"

namespace foretouch::tools {
namespace {

constexpr std::array<LeafStage, kLeafStages> kStages = {LeafStage::Filter, LeafStage::Exact};

bool isLabelled(const TimedSet& set) {
  return !set.leaves.empty() && set.leaves.front().truth.has_value();
}

bool isHandcrafted(const TimedSet& set) {
  return set.name.rfind("erleben-", 0) == 0;
}

std::string wrongOf(const LeafGroup& g) {
  return g.labelled ? fmt::format("{}", g.falseNegatives + g.falsePositives) : "-";
}

std::string row(const LeafGroup& g) {
  std::string line = fmt::format("{:<28} {:<12} {:<9} {:>9} {:>6}", g.name, g.kind,
                                 g.positive ? "meet" : "miss", g.count, wrongOf(g));
  for (const std::size_t decided : g.decided) {
    line += fmt::format(" {:>8.3f}",
                        100.0 * static_cast<double>(decided) / static_cast<double>(g.count));
  }
  for (const double mean : g.decidedMeanUs) line += fmt::format(" {:>9.3f}", mean);
  return line + fmt::format(" {:>9.3f} {:>9.3f} {:>9.3f} {:>10.3f}\n", g.time.meanUs,
                            g.time.medianUs, g.time.p99Us, g.time.maxUs);
}

nlohmann::ordered_json toJson(const LeafGroup& g) {
  nlohmann::ordered_json json = {{"set", g.name},
                                 {"kind", g.kind},
                                 {"positive", g.positive},
                                 {"count", g.count},
                                 {"false_negatives", nullptr},
                                 {"false_positives", nullptr}};
  if (g.labelled) {
    json["false_negatives"] = g.falseNegatives;
    json["false_positives"] = g.falsePositives;
  }
  auto& stages = json["stages"];
  for (std::size_t s = 0; s < kLeafStages; ++s) {
    stages[toString(kStages[s])] = {{"count", g.decided[s]}, {"mean_us", g.decidedMeanUs[s]}};
  }
  json["mean_us"] = g.time.meanUs;
  json["median_us"] = g.time.medianUs;
  json["p99_us"] = g.time.p99Us;
  json["max_us"] = g.time.maxUs;
  return json;
}

}  // namespace

std::vector<LeafGroup> leafGroups(const LeafBench& bench) {
  std::vector<TimedSet> sets = bench.sets;
  for (TimedSet& set : joined(bench.sets, "handcrafted", isHandcrafted)) {
    sets.push_back(std::move(set));
  }
  for (TimedSet& set : joined(bench.sets, "all", isLabelled)) sets.push_back(std::move(set));
  std::vector<LeafGroup> groups;
  for (const TimedSet& set : sets) {
    for (LeafGroup& group : groupsOf(set)) groups.push_back(std::move(group));
  }
  return groups;
}

std::string leafTable(const LeafBench& bench) {
  std::string text = fmt::format(
      "{:<28} {:<12} {:<9} {:>9} {:>6} {:>17} {:>19} {:>41}\n"
      "{:<28} {:<12} {:<9} {:>9} {:>6} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} "
      "{:>10}\n",
      "", "", "", "", "", "decided by, %", "their mean, us", "time of a query, us", "set", "kind",
      "truth", "queries", "wrong", "filter", "exact", "filter", "exact", "mean", "median", "p99",
      "max");
  for (const LeafGroup& group : leafGroups(bench)) text += row(group);
  text += fmt::format(
      "\ntime of a query: the least of {} passes over its set, less {:.3f} us for the clock\n",
      bench.repeat, bench.overheadUs);
  if (bench.generated > 0) {
    text += fmt::format("generated: {} queries a kind, seed {}; not judged\n", bench.generated,
                        bench.seed);
  }
  return text;
}

std::string leafJson(const LeafBench& bench) {
  nlohmann::ordered_json json = {{"repeat", bench.repeat},
                                 {"clock_overhead_us", bench.overheadUs},
                                 {"generated", bench.generated},
                                 {"seed", bench.seed},
                                 {"groups", nlohmann::ordered_json::array()}};
  for (const LeafGroup& group : leafGroups(bench)) json["groups"].push_back(toJson(group));
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::size_t wrongAnswers(const LeafBench& bench) {
  std::size_t wrong = 0;
  for (const TimedSet& set : bench.sets) {
    for (const TimedLeaf& leaf : set.leaves) {
      if (leaf.truth && *leaf.truth != leaf.hits) ++wrong;
    }
  }
  return wrong;
}

namespace {

constexpr std::int64_t kMaxRepeat = 1'000'000, kMaxGenerated = 10'000'000;
constexpr double kRigidBand = 1e-3;  // metres; a common tolerance

struct AskedLeaves {
  std::vector<std::string> folders;
  int repeat = 5;
  std::size_t generated = 0;
  std::uint64_t seed = 1;
  std::string json;
};

TimedSet timed(const QuerySet& set, int repeat, bool labelled) {
  TimedSet result{set.name, toString(set.kind), {}};
  result.leaves = timeLeaves(set.queries.size(), repeat,
                             [&](std::size_t i) { return answer(set.kind, set.queries[i]); });
  if (!labelled) return result;
  for (std::size_t i = 0; i < set.queries.size(); ++i) {
    result.leaves[i].truth = set.queries[i].hits;
  }
  return result;
}

void addGenerated(LeafBench& bench) {
  for (const QueryKind kind : {QueryKind::VertexFace, QueryKind::EdgeEdge}) {
    const QuerySet set{"generated", kind, generatedQueries(kind, bench.generated, bench.seed)};
    bench.sets.push_back(timed(set, bench.repeat, false));
  }
  const auto pairs = generatedRigidPairs(bench.generated, bench.seed);
  TimedSet rigid{"generated", "rigid pair", {}};
  rigid.leaves = timeLeaves(pairs.size(), bench.repeat, [&](std::size_t i) {
    const RigidPair& p = pairs[i];
    return rigidTrianglePair(p.motion, p.moving_L, p.fixed_W, kRigidBand).leaf;
  });
  bench.sets.push_back(std::move(rigid));
}

ExitCode run(const AskedLeaves& asked) {
  if (asked.folders.empty() && asked.generated == 0) {
    return failed(Error::in("bench leaf", ErrorCode::Empty, "expected --queries or --generated"));
  }
  LeafBench bench;
  bench.repeat = asked.repeat;
  bench.seed = asked.seed;
  bench.generated = asked.generated;
  bench.overheadUs = clockOverheadUs();
  FORETOUCH_TRY_OR(failed, const auto sets, readQuerySets(asked.folders));
  for (const QuerySet& set : sets) bench.sets.push_back(timed(set, bench.repeat, true));
  if (bench.generated > 0) addGenerated(bench);
  FORETOUCH_CHECK_OR(failed, writeText(asked.json, leafJson(bench)));
  printOut(leafTable(bench));
  const std::size_t wrong = wrongAnswers(bench);
  if (wrong == 0) return ExitCode::Done;
  printError(fmt::format("{} answers differ from their labels", wrong));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command leafCommand() {
  const auto asked = std::make_shared<AskedLeaves>();
  Settings settings;
  settings.list("--queries", "FOLDER", asked->folders,
                "Folder with query sets: CSV files in folders named vertex-face or edge-edge; may "
                "be repeated");
  settings.whole("--generated", "N", asked->generated, 0, kMaxGenerated,
                 "So many made-up queries of each kind, rigid pairs too");
  settings.whole("--seed", "S", asked->seed, 0, std::numeric_limits<std::int64_t>::max(),
                 "Of the made-up queries");
  settings.whole("--repeat", "N", asked->repeat, 1, kMaxRepeat,
                 "Passes over each set; a query's least time counts");
  settings.output("--json", "FILE", asked->json, "Also write the figures to a file");
  Command command{
      "leaf", "Answer and time exact leaf queries; exit code 1 where an answer is not its label",
      "Example:\n  foretouch-bench leaf --queries sample-queries --repeat 10 --json leaf.json",
      std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
