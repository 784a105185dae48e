#include "bench/person/person_tables.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "bench/solid/cells.h"
#include "bench/timing.h"

namespace foretouch::tools {

const char* toString(Asked asked) {
  switch (asked) {
    case Asked::Scene: return "scene";
    case Asked::OwnLinks: return "own links";
    case Asked::OtherPerson: return "other person";
  }
  return "scene";
}

BenchTable bracketTable(const PersonTallies& tallies, double learned) {
  BenchTable table{
      learned > 0.0 ? "strangers" : "oracle",
      learned > 0.0 ? fmt::format("Brackets by bounds of strangers, at the quantile {:g}", learned)
                    : "Brackets of persons whose poses are held back, by the bounds of their "
                      "clip",
      {{"asked", "asked"},
       {"rate_hz", "Hz", 0},
       {"between", "between"},
       {"intervals", "links and steps"},
       {"missed", "missed"},
       {"lied", "lied"},
       {"undecided_percent", "undecided %", 2},
       {"fresh", "began"},
       {"missed_by_poses", "of them no pose shows"},
       {"missed_between", "missed by the constant rate"},
       {"invented_between", "invented by it"},
       {"certain_percent", "certain %", 1},
       {"passed", "passed a surface"},
       {"width_p50_ms", "bracket p50 ms", 2},
       {"width_p90_ms", "p90 ms", 1},
       {"growth_p50_mm", "bound p50 mm", 2},
       {"pieces", "pieces", 1},
       {"cost", "times a plain step", 1}},
      {}};
  for (const auto& [kind, t] : tallies) {
    const Percentiles widths = percentilesOf(t.widthsMs), growths = percentilesOf(t.growthsMm);
    const auto& [asked, rateHz, model] = kind;
    const double steps = static_cast<double>(std::max<std::uint64_t>(t.steps, 1));
    table.rows.push_back(
        {std::string(toString(asked)), -rateHz, std::string(toString(model)), cell(t.intervals),
         cell(t.missed), cell(t.lied), percent(t.possible, t.intervals), cell(t.fresh),
         cell(t.missedByPoses), cell(t.missedBetween), cell(t.inventedBetween),
         percent(t.freshCertain, t.fresh), cell(t.passed), widths.p50, widths.p90, growths.p50,
         static_cast<double>(t.pieces) / steps, t.plainUs > 0.0 ? t.bracketUs / t.plainUs : 0.0});
  }
  return table;
}

BenchTable widthTable(const PersonTallies& tallies) {
  BenchTable table{"widths",
                   "Brackets of begins beside the least that the bounds allow, by approach",
                   {{"rate_hz", "Hz", 0},
                    {"between", "between"},
                    {"approach", "approach m/s"},
                    {"touches", "touches"},
                    {"growth_p50_mm", "bound there p50 mm", 2},
                    {"width_p50_ms", "bracket p50 ms", 2},
                    {"least_p50_ms", "least p50 ms", 2},
                    {"times_p50", "times the least p50", 2},
                    {"times_p90", "p90", 2}},
                   {}};
  struct Class {
    double from, to;  // metres per second
    const char* name;
  };
  constexpr double kAny = 1e9, kLeastMs = 1e-3;
  constexpr std::array<Class, 5> kClasses = {{{0.0, 0.1, "to 0.1"},
                                              {0.1, 0.3, "0.1 to 0.3"},
                                              {0.3, 1.0, "0.3 to 1"},
                                              {1.0, kAny, "from 1"},
                                              {0.0, kAny, "all"}}};
  for (const auto& [kind, tally] : tallies) {
    const auto& [asked, rateHz, model] = kind;
    if (asked != Asked::Scene) continue;
    for (const Class& one : kClasses) {
      std::vector<double> growths, widths, least, times;
      for (const BracketWidth& width : tally.widths) {
        if (width.approach < one.from || width.approach >= one.to) continue;
        growths.push_back(width.growthMm);
        widths.push_back(width.ms);
        least.push_back(width.leastMs);
        times.push_back(width.ms / std::max(width.leastMs, kLeastMs));
      }
      const Percentiles more = percentilesOf(times);
      table.rows.push_back({-rateHz, std::string(toString(model)), std::string(one.name),
                            cell(widths.size()), percentilesOf(growths).p50,
                            percentilesOf(widths).p50, percentilesOf(least).p50, more.p50,
                            more.p90});
    }
  }
  return table;
}

BenchTable aheadTable(const AheadTallies& tallies, double horizonS) {
  BenchTable table{"ahead",
                   fmt::format("Not before: what may be touched within {:g} s of a pose", horizonS),
                   {{"rate_hz", "Hz", 0},
                    {"by", "by"},
                    {"asked", "links and poses"},
                    {"touched", "touched"},
                    {"late", "later than the truth"},
                    {"early_p50_ms", "early p50 ms", 1},
                    {"early_p90_ms", "p90 ms", 1},
                    {"alarms_percent", "false alarms %", 2},
                    {"us", "us per pose", 1}},
                   {}};
  for (const auto& [rate, rows] : tallies) {
    for (std::size_t way = 0; way < rows.size(); ++way) {
      const AheadTally& t = rows[way];
      const Percentiles early = percentilesOf(t.earlyMs);
      table.rows.push_back({-rate, std::string(toString(static_cast<AheadWay>(way))), cell(t.asked),
                            cell(t.touched), cell(t.late), early.p50, early.p90,
                            percent(t.alarms, t.asked - t.touched),
                            t.poses > 0 ? t.us / static_cast<double>(t.poses) : 0.0});
    }
  }
  return table;
}

}  // namespace foretouch::tools
