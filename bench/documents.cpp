#include "bench/documents.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/commands.h"

namespace foretouch::tools {
namespace {

constexpr char kQuantities[] = "quantities";

const BenchTable* tableNamed(const BenchReport& report, const std::string& name) {
  for (const BenchTable& table : report.tables) {
    if (table.name == name) return &table;
  }
  return nullptr;
}

double numberOf(const BenchCell& cell) {
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  return std::numeric_limits<double>::quiet_NaN();
}

double quantity(const BenchReport& report, const std::string& name) {
  const BenchTable* const table = tableNamed(report, kQuantities);
  if (table == nullptr) return std::numeric_limits<double>::quiet_NaN();
  for (const auto& row : table->rows) {
    const auto* const found = row.size() == 2 ? std::get_if<std::string>(&row[0]) : nullptr;
    if (found != nullptr && *found == name) return numberOf(row[1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<std::string> quantitiesOf(const BenchReport& report) {
  std::vector<std::string> names;
  const BenchTable* const table = tableNamed(report, kQuantities);
  if (table == nullptr) return names;
  for (const auto& row : table->rows) {
    const auto* const name = row.empty() ? nullptr : std::get_if<std::string>(&row[0]);
    if (name != nullptr) names.push_back(*name);
  }
  return names;
}

}  // namespace

Result<BenchReport> readReport(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxReportBytes));
  return parseReport(text, path);
}

Result<std::int64_t> callgrindInstructions(const std::string& text, const std::string& name) {
  for (const std::string& key : {std::string("\ntotals: "), std::string("\nsummary: ")}) {
    const std::size_t place = text.rfind(key);
    if (place == std::string::npos) continue;
    std::int64_t instructions = 0;
    const char* const from = text.data() + place + key.size();
    const auto read = std::from_chars(from, text.data() + text.size(), instructions);
    if (read.ec == std::errc() && instructions > 0) return instructions;
  }
  return Error::in(name, ErrorCode::Syntax,
                   "expected callgrind's 'totals:' with the instructions of at least one step");
}

Result<BenchReport> instructionReport(const BenchReport& latency, std::int64_t instructions) {
  const BenchTable* const counters = tableNamed(latency, "counters");
  const BenchTable* const times = tableNamed(latency, "latency");
  if (counters == nullptr || counters->rows.empty() || times == nullptr || times->rows.empty()) {
    return Error::of(ErrorCode::Mismatch, "expected the file of bench latency --json");
  }
  double steps = 0.0;
  for (std::size_t c = 0; c < times->columns.size(); ++c) {
    if (times->columns[c].key == "steps") steps = numberOf(times->rows.front()[c]);
  }
  BenchTable table{kQuantities,
                   "A step's work, mean counts",
                   {{"quantity", "quantity", 0}, {"per_step", "a step", 2}},
                   {}};
  table.rows.push_back({std::string("instructions"), static_cast<double>(instructions) / steps});
  for (std::size_t c = 0; c < counters->columns.size(); ++c) {
    const std::string& key = counters->columns[c].key;
    if (key == "rate_hz" || key == "tolerance_m" || key == "simd") continue;
    table.rows.push_back({key, numberOf(counters->rows.front()[c])});
  }
  BenchReport report = latency;
  report.kind = "instructions";
  report.title = "Instructions of a step";
  report.machine.erase(std::remove_if(report.machine.begin(), report.machine.end(),
                                      [](const BenchFact& fact) {
                                        return fact.first != "compiler" && fact.first != "build" &&
                                               fact.first != "version";
                                      }),
                       report.machine.end());
  report.tables = {std::move(table)};
  report.notes = {
      "Counted by valgrind's callgrind in a run without timing, from the two poses to "
      "the contacts. They depend on the compiler and the vector width, and by some hundredths of a "
      "percent on where memory happens to lie."};
  return report;
}

BenchTable movedTable(const BenchReport& recorded, const BenchReport& now) {
  std::vector<std::string> names = quantitiesOf(now);
  for (const std::string& name : quantitiesOf(recorded)) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  BenchTable table{"moved",
                   "A step's work against the record",
                   {{"quantity", "quantity", 0},
                    {"recorded", "recorded", 2},
                    {"now", "now", 2},
                    {"moved_percent", "moved %", 2}},
                   {}};
  for (const std::string& name : names) {
    const double before = quantity(recorded, name), after = quantity(now, name);
    const double moved = before == after ? 0.0 : 100.0 * (after - before) / before;
    table.rows.push_back({name, before, after, moved});
  }
  return table;
}

namespace {

/// A callgrind file of this program has a few megabytes.
constexpr std::size_t kMaxCallgrindBytes = std::size_t{1} << 30;

ExitCode runReport(const std::vector<std::string>& files) {
  for (const std::string& path : files) {
    FORETOUCH_TRY_OR(failed, const auto report, readReport(path));
    printOut(reportText(report) + "\n");
  }
  return ExitCode::Done;
}

struct AskedInstructions {
  std::string callgrind, latency, recorded;
  bool record = false;
};

Result<BenchReport> countedNow(const AskedInstructions& asked) {
  FORETOUCH_TRY(const auto profile, readWholeFile(asked.callgrind, kMaxCallgrindBytes));
  FORETOUCH_TRY(const auto instructions, callgrindInstructions(profile, asked.callgrind));
  FORETOUCH_TRY(const auto latency, readReport(asked.latency));
  auto now = instructionReport(latency, instructions);
  if (!now.ok()) return inFile(now.error(), asked.latency);
  return now;
}

ExitCode runInstructions(const AskedInstructions& asked) {
  FORETOUCH_TRY_OR(failed, const auto now, countedNow(asked));
  if (asked.record) {
    FORETOUCH_CHECK_OR(failed, writeText(asked.recorded, reportJson(now)));
    printOut(reportText(now));
    return ExitCode::Done;
  }
  FORETOUCH_TRY_OR(failed, const auto recorded, readReport(asked.recorded));
  printOut(tableText(movedTable(recorded, now)));
  return ExitCode::Done;
}

}  // namespace

Command reportCommand() {
  const auto files = std::make_shared<std::vector<std::string>>();
  Settings settings;
  settings.list("files", "FILE...", *files, "Files that --json wrote")
      .required("files that --json wrote");
  Command command{"report", "Print files of --json as tables",
                  "Example:\n  foretouch-bench report docs/measurements/world.json",
                  std::move(settings)};
  command.run = [files](const Settings&) { return runReport(*files); };
  return command;
}

Command instructionsCommand() {
  const auto asked = std::make_shared<AskedInstructions>();
  Settings settings;
  settings.path("--callgrind", "FILE", asked->callgrind, "callgrind.out of the run").required();
  settings.path("--latency", "FILE", asked->latency, "What --json wrote in the run").required();
  settings.path("--recorded", "FILE", asked->recorded, "The record").required();
  settings.flag("--record", asked->record, "Write the record instead of comparing");
  Command command{"instructions",
                  "Compare callgrind's count of a latency run with the recorded one",
                  "`./run instructions` does the whole.", std::move(settings)};
  command.run = [asked](const Settings&) { return runInstructions(*asked); };
  return command;
}

}  // namespace foretouch::tools
