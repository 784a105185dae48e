#include "bench/extremes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/extremes/case_json.h"
#include "bench/extremes/float_mode.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "lss/index.h"
#include "tools/progress.h"
#include "tools/settings/lists.h"

namespace foretouch::tools {
namespace {

using namespace extremes;

constexpr std::size_t kMostFindings = 40;

BenchTable familyTable() {
  return {"families",
          "Extremes by family: links of answers, and the worst of each measure with its seed",
          {{"family", "family", 0},
           {"cases", "cases", 0},
           {"refused", "refused", 0},
           {"queries", "queries", 0},
           {"contacts", "contacts", 0},
           {"starts", "starts", 0},
           {"clear", "clear", 0},
           {"undecided", "undec.", 0},
           {"unsound", "unsound", 0},
           {"faulty", "faulty", 0},
           {"open", "open", 0},
           {"tightness_eps", "sep/eps", -1},
           {"tightness_seed", "seed", 0},
           {"excess_ulps", "past eps, ulps", -1},
           {"start_ulps", "start, ulps", -1},
           {"start_share", "of allowed", -1},
           {"start_seed", "seed", 0},
           {"margin_eps", "margin/eps", -1},
           {"margin_seed", "seed", 0},
           {"unresolved", "undec. eps/need", -1},
           {"work", "most work", 0},
           {"work_seed", "seed", 0}},
          {}};
}

double numberOr(const Worst& worst) {
  return std::isfinite(worst.value) ? worst.value : std::numeric_limits<double>::quiet_NaN();
}
std::int64_t seedOf(const Worst& worst) {
  return static_cast<std::int64_t>(worst.seed);
}

std::vector<BenchCell> rowOf(const std::string& name, const Tally& t) {
  const auto of = [&](Fault fault) { return t.faults[slotOf(fault)]; };
  const std::int64_t faulty = of(Fault::Malformed) + of(Fault::Accepted) + of(Fault::Overworked) +
                              of(Fault::Loose) + of(Fault::Needless);
  return {name,
          t.cases,
          t.refused,
          t.queries,
          t.contacts,
          t.starts,
          t.clear,
          t.undecided,
          of(Fault::Late),
          faulty,
          of(Fault::Open),
          numberOr(t.tightness),
          seedOf(t.tightness),
          numberOr(t.excess),
          numberOr(t.start),
          numberOr(t.startShare),
          seedOf(t.start),
          -numberOr(t.lateness),
          seedOf(t.lateness),
          numberOr(t.unresolved),
          static_cast<std::int64_t>(std::max(0.0, t.work.value)),
          seedOf(t.work)};
}

class Campaign {
 public:
  explicit Campaign(const ExtremesRequest& request) : request_(request) {}

  ExtremesBench run(const std::vector<const Family*>& chosen) {
    BenchTable table = familyTable();
    for (const Family* family : chosen) {
      const Tally tally = runFamily(*family);
      table.rows.push_back(rowOf(family->name, tally));
      bench_.tallies.push_back(tally);
    }
    describe(std::move(table));
    return std::move(bench_);
  }

 private:
  Tally runFamily(const Family& family) {
    Tally tally;
    const std::int64_t cases = std::max<std::int64_t>(1, request_.cases / family.share);
    ProgressBar progress(family.name, cases);
    std::set<std::uint64_t> named;
    for (std::int64_t i = 0; i < cases; ++i) {
      const std::uint64_t seed = request_.seed + static_cast<std::uint64_t>(i);
      const auto findings = judge(makeCase(family, seed, request_.sizes), tally);
      progress.advanceTo(i + 1);
      if (findings.empty()) continue;
      named.insert(seed);
      for (const Finding& finding : findings) {
        bench_.isSound = bench_.isSound && !isFailure(finding.fault);
        if (bench_.findings.size() < kMostFindings) bench_.findings.push_back(finding);
      }
    }
    for (const Worst* worst : {&tally.tightness, &tally.start, &tally.lateness, &tally.work}) {
      if (std::isfinite(worst->value)) named.insert(worst->seed);
    }
    for (const std::uint64_t seed : named) {
      if (bench_.worst.size() < kMostFindings * 4) {
        bench_.worst.push_back(makeCase(family, seed, request_.sizes));
      }
    }
    return tally;
  }

  void describe(BenchTable table) {
    BenchReport& report = bench_.report;
    report = startedReport("extremes", "Extremes");
    report.workload = {
        {"cases a family", fmt::format("{}, seeds from {}", request_.cases, request_.seed)},
        {"asked", fmt::format("both backtrackings, every width, both cullers, each fidelity, "
                              "denormals kept{}",
                              canFlushDenormals() ? " and flushed" : "")},
        {"truth", "the motion and its distances in fifty digits; freedom proven span by span"}};
    report.tables = {std::move(table)};
    report.notes = {
        "unsound: touched before the instant up to which freedom is claimed. faulty: malformed, "
        "accepted, overworked, loose or needlessly undecided. open: not proven by the oracle.",
        "sep/eps: the largest separation at a contact; margin/eps: the least separation met before "
        "any answer's instant. Ulps are 2^-52 of the extent: of the largest coordinate involved.",
        "start: how far from touching a start in contact was; of allowed: over what is proven."};
    for (const Finding& finding : bench_.findings) report.notes.push_back(finding.what);
  }

  const ExtremesRequest& request_;
  ExtremesBench bench_;
};

}  // namespace

Result<ExtremesBench> measureExtremes(const ExtremesRequest& request) {
  std::vector<const Family*> chosen;
  for (const Family& family : families()) {
    if (isAsked(request.only, family.name)) chosen.push_back(&family);
  }
  for (const std::string& name : request.only) {
    const bool isOne = std::any_of(families().begin(), families().end(),
                                   [&](const Family& family) { return family.name == name; });
    if (!isOne) {
      return Error::in("--only", ErrorCode::UnknownName,
                       "expected a family that --list shows, found '" + name + "'");
    }
  }
  return Campaign(request).run(chosen);
}

std::string familiesText() {
  std::string text;
  for (const Family& family : families()) {
    text +=
        fmt::format("{:<14} {} ({} members)\n", family.name, family.about, family.members.size());
  }
  return text;
}

namespace {

constexpr int kMostCases = 10'000'000, kMostSeed = 2'000'000'000, kMostCoincident = 10'000'000;

struct AskedExtremes {
  ExtremesRequest request;
  FigureFiles figures;
  std::string dump;
  bool lists = false;
};

ExitCode run(AskedExtremes& asked) {
  if (asked.lists) {
    printOut(familiesText());
    return ExitCode::Done;
  }
  FORETOUCH_TRY_OR(failed, const auto bench, measureExtremes(asked.request));
  FORETOUCH_CHECK_OR(failed, writeText(asked.dump, extremes::casesJson(bench.worst)));
  return finished(
      bench.report, bench.report.tables.front(), asked.figures,
      bench.isSound ? "" : "answers are unsound or faulty: see the notes below the table");
}

constexpr char kFooter[] =
    R"(Case i of a family has the seed --seed + i: --only FAMILY --seed S --cases 1 replays it.
Examples:
  foretouch-bench extremes --cases 20
  foretouch-bench extremes --only far,grazing --cases 1000 --json extremes.json
  foretouch-bench extremes --only denormals --seed 42 --cases 1 --dump case.json)";

}  // namespace

Command extremesCommand() {
  const auto asked = std::make_shared<AskedExtremes>();
  ExtremesRequest& request = asked->request;
  Settings settings;
  settings.whole("--cases", "N", request.cases, 1, kMostCases,
                 "Of each family; costly families take a share of it");
  settings.whole("--seed", "S", request.seed, 1, kMostSeed, "Of each family's first case");
  addWords(settings, "--only", "FAMILY,...", request.only, {}, "These families (--list)");
  settings.whole("--coincident", "N", request.sizes.coincident, 1, kMostCoincident,
                 "Triangles in one place");
  addFigures(settings, asked->figures, "Also write the table to a file");
  settings.output("--dump", "FILE", asked->dump,
                  "Also write the worst and the faulty inputs to a file");
  settings.flag("--list", asked->lists, "Show the families");
  Command command{"extremes",
                  "Inputs at the edge of what is legal, against an oracle of fifty digits; exit "
                  "code 1 on any unsound or faulty answer",
                  kFooter, std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
