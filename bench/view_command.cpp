#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/crowds.h"
#include "tools/settings/lists.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/private_network.h"
#include "bench/view.h"
#include "network/watch/audience.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedView {
  ViewRequest request;
  std::vector<StreamCrowd> crowds{{4, 90}};
  std::vector<int> viewers{1, 10, 50};
  std::string json, csv;
};

ExitCode run(AskedView& asked) {
  ViewRequest& request = asked.request;
  request.crowd = asked.crowds.front();
  request.viewers = {0};
  request.viewers.insert(request.viewers.end(), asked.viewers.begin(), asked.viewers.end());
  request.command = ownCommandLine();
  FORETOUCH_CHECK_OR(failed, enterPrivateNetwork());
  FORETOUCH_TRY_OR(failed, const auto bench, measureView(request));
  const BenchReport& report = bench.report;
  FORETOUCH_CHECK_OR(failed, writeReport(report, asked.json, report.tables.front(), asked.csv));
  printOut(reportText(report));
  return ExitCode::Done;
}

}  // namespace

Command viewBenchCommand() {
  constexpr int kMaxRepeats = 1000;
  const auto asked = std::make_shared<AskedView>();
  ViewRequest& request = asked->request;
  Settings settings;
  addCrowds(settings, "--crowd", "NxHZ", asked->crowds,
            "So many avatars, each so many poses a second");
  addCounts(settings, "--viewers", "N,...", asked->viewers, static_cast<int>(kMaxViewers),
            "Rows with so many viewers, after one with none");
  settings.number("--seconds", "S", request.durationS, kAboveZero, "Of each run");
  settings.whole("--repeat", "N", request.repeats, 1, kMaxRepeats, "Runs of each row, in turns");
  addWorkers(settings, request.workers);
  addDancerPlace(settings, request.place);
  addFigures(settings, asked->json, asked->csv, "Also write the table to a file");
  Command command{"view",
                  "What being watched costs a service, and how late viewers see what is sent",
                  "Example:\n  foretouch-bench view --crowd 10x90 --viewers 10 --json view.json",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
