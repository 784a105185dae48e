#include "bench/view.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/event_readers.h"
#include "bench/machine.h"
#include "bench/service_process.h"
#include "bench/timing.h"

namespace foretouch::tools {
namespace {

/// In a private network, where it is free.
constexpr std::uint16_t kPort = 9465;
constexpr double kUsPerS = 1e6, kUsPerMs = 1e3, kBytesPerKb = 1024.0;

/// One row's results over all its runs.
struct Row {
  std::optional<int> viewers;  ///< None: the service has no view.
  std::vector<double> addedUs, roundTripUs, stepDelaysUs, contactDelaysUs;
  std::vector<double> addedP99Us;  ///< Of each run.
  std::int64_t poses = 0, lost = 0, ended = 0, bytes = 0;
};

void appendAll(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

void add(const LoadOutcome& outcome, const ReadEvents& read, Row& row) {
  std::vector<double> added;
  added.reserve(outcome.answers.size());
  for (const LoadAnswer& answer : outcome.answers) {
    added.push_back(std::max(0.0F, answer.serviceUs - answer.queryUs));
    row.roundTripUs.push_back(answer.roundTripUs);
  }
  std::sort(added.begin(), added.end());
  row.addedP99Us.push_back(valueAtRank(added, 0.99));
  appendAll(row.addedUs, added);
  appendAll(row.stepDelaysUs, read.stepDelaysUs);
  appendAll(row.contactDelaysUs, read.contactDelaysUs);
  row.poses += outcome.sent;
  row.lost += outcome.unanswered;
  row.ended += read.ended;
  row.bytes += read.bytes;
}

Result<Done> runOnce(const ViewRequest& request, const LoadTrack& track, Row& row) {
  LoadRequest load;
  load.senders = sendersOf({request.crowd});
  load.durationS = request.durationS;
  std::vector<std::string> arguments =
      serviceArguments(request.files, load.senders.size(), request.workers, std::string());
  if (row.viewers) arguments.push_back(fmt::format("--view=127.0.0.1:{}", kPort));
  FORETOUCH_TRY(auto service, ServiceProcess::start(arguments));
  auto readers =
      EventReaders::start(row.viewers.value_or(0), kPort, kUsPerS / request.crowd.rateHz);
  if (!readers.ok()) return readers.error();
  FORETOUCH_TRY(const auto outcome, runLoad(track, load));
  add(outcome, readers.value().stop(), row);
  service.stop();
  return Done{};
}

BenchTable viewTable() {
  return {"view",
          "What the service adds to a query (us), and how late viewers see it (ms)",
          {{"viewers", "viewers", 0},
           {"poses", "poses", 0},
           {"lost", "lost", 0},
           {"added_p50_us", "added p50", 0},
           {"added_p99_us", "added p99", 0},
           {"added_p99_least_us", "p99 of the best run", 0},
           {"added_p99_most_us", "and the worst", 0},
           {"round_trip_p50_us", "round trip p50", 0},
           {"round_trip_p99_us", "round trip p99", 0},
           {"step_p50_ms", "step seen p50", 1},
           {"step_p99_ms", "step seen p99", 1},
           {"contact_p50_ms", "contact seen p50", 1},
           {"contact_p99_ms", "contact seen p99", 1},
           {"contact_max_ms", "contact seen max", 1},
           {"kb_per_s", "kB/s to each", 0},
           {"ended", "viewers let go", 0}},
          {}};
}

std::vector<BenchCell> cellsOf(Row row, double secondsInAll) {
  for (std::vector<double>* values :
       {&row.addedUs, &row.roundTripUs, &row.stepDelaysUs, &row.contactDelaysUs, &row.addedP99Us}) {
    std::sort(values->begin(), values->end());
  }
  const int viewers = row.viewers.value_or(0);
  std::vector<BenchCell> cells;
  cells.reserve(16);
  cells.emplace_back(row.viewers ? std::to_string(viewers) : "no view");
  cells.emplace_back(row.poses);
  cells.emplace_back(row.lost);
  cells.emplace_back(valueAtRank(row.addedUs, 0.5));
  cells.emplace_back(valueAtRank(row.addedUs, 0.99));
  cells.emplace_back(row.addedP99Us.front());
  cells.emplace_back(row.addedP99Us.back());
  cells.emplace_back(valueAtRank(row.roundTripUs, 0.5));
  cells.emplace_back(valueAtRank(row.roundTripUs, 0.99));
  cells.emplace_back(valueAtRank(row.stepDelaysUs, 0.5) / kUsPerMs);
  cells.emplace_back(valueAtRank(row.stepDelaysUs, 0.99) / kUsPerMs);
  cells.emplace_back(valueAtRank(row.contactDelaysUs, 0.5) / kUsPerMs);
  cells.emplace_back(valueAtRank(row.contactDelaysUs, 0.99) / kUsPerMs);
  cells.emplace_back(valueAtRank(row.contactDelaysUs, 1.0) / kUsPerMs);
  cells.emplace_back(
      viewers == 0 ? 0.0 : static_cast<double>(row.bytes) / kBytesPerKb / viewers / secondsInAll);
  cells.emplace_back(row.ended);
  return cells;
}

}  // namespace

Result<StreamBench> measureView(const ViewRequest& given) {
  FORETOUCH_TRY(const auto inputs, loadBenchInputs(given.files));
  FORETOUCH_TRY(const auto track, loadTrack(inputs, given.place));
  ViewRequest request = given;
  request.files = inputs.files;
  std::vector<Row> rows(1);
  for (const int viewers : request.viewers) rows.emplace_back().viewers = viewers;
  for (int repeat = 0; repeat < request.repeats; ++repeat) {
    for (Row& row : rows) {
      FORETOUCH_CHECK(runOnce(request, track, row));
    }
  }
  StreamBench bench;
  BenchTable table = viewTable();
  for (Row& row : rows) {
    bench.lost += row.lost;
    table.rows.push_back(cellsOf(std::move(row), request.durationS * request.repeats));
  }
  BenchReport& report = bench.report;
  report.kind = "view";
  report.title = "The stream, watched";
  report.command = request.command;
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = streamFacts(inputs, request.workers);
  report.workload.emplace_back("senders", fmt::format("{} at {} poses a second",
                                                      request.crowd.avatars, request.crowd.rateHz));
  report.tables.push_back(std::move(table));
  report.notes = {
      "Senders, the receiver of verdicts and all viewers are one process, the service another. "
      "Rows "
      "take turns; ranks are over all answers, and over all viewers' events, of a row.",
      "Added: from the system's stamp on the pose's datagram to the answer's hand-over, less the "
      "query. Seen: from when the pose was due to be sent to when the whole event had been read; a "
      "contact counts from the pose that ends its own step, also where that step was skipped."};
  return bench;
}

}  // namespace foretouch::tools
