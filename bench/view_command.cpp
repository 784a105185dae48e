#include "bench/view_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/private_network.h"
#include "bench/stream_command.h"
#include "bench/view.h"
#include "network/watch/audience.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

constexpr int kMaxRepeats = 1000, kMaxWorkers = 64;

struct ViewTexts {
  std::string crowd = "4x90", viewers = "1,10,50", seconds = "10", repeat = "3", workers = "1",
              place = "0,0,0,0", json, csv;
};

ExitCode runView(const ViewTexts& texts) {
  ViewRequest request;
  std::vector<StreamCrowd> crowds;
  std::vector<int> viewers;
  Settling settle;
  settle.into(crowds, parseCrowds("--crowd", texts.crowd));
  settle.into(viewers, parseCounts("--viewers", texts.viewers, static_cast<int>(kMaxViewers)));
  settle.into(request.durationS, parsePositive("--seconds", texts.seconds));
  settle.into(request.repeats, parseCount("--repeat", texts.repeat, kMaxRepeats));
  settle.into(request.workers, parseCount("--workers", texts.workers, kMaxWorkers));
  settle.into(request.place, parsePlacement("--place", texts.place));
  if (settle.error()) return failed(*settle.error());
  request.crowd = crowds.front();
  request.viewers = {0};
  request.viewers.insert(request.viewers.end(), viewers.begin(), viewers.end());
  request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto bench, measureView(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, texts.json, report.tables.front(), texts.csv));
  printOut(reportText(report));
  return ExitCode::Done;
}

}  // namespace

void addBenchViewCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<ViewTexts>();
  CLI::App* const command = bench.add_subcommand(
      "view", "What being watched costs a service, and how late viewers see what is sent");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--crowd", texts->crowd, "NxHZ", "So many avatars, each so many poses a second");
  option("--viewers", texts->viewers, "N,...", "Rows with so many viewers, after one with none");
  option("--seconds", texts->seconds, "S", "Of each run");
  option("--repeat", texts->repeat, "N", "Runs of each row, in turns");
  option("--workers", texts->workers, "N", "Threads of the service that answer");
  option("--place", texts->place, "X,Y,Z[,YAW]", "Where the bundled dancer stands in the room");
  option("--json", texts->json, "FILE", "Also write the figures to a file");
  option("--csv", texts->csv, "FILE", "Also write the table to a file");
  command->footer("Example:\n  foretouch-bench view --crowd 10x90 --viewers 10 --json view.json");
  command->callback([texts, &exit] { exit = runView(*texts); });
}

}  // namespace foretouch::tools
