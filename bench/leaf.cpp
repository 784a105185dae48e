#include "bench/leaf.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

}  // namespace foretouch::tools
