#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/latency.h"
#include "tools/settings/lists.h"
#include "bench/options.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

ExitCode run(LatencyRequest& request) {
  BenchOptions& options = request.options;
  FORETOUCH_CHECK_OR(failed, complete(options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureLatency(request));
  FORETOUCH_CHECK_OR(failed,
                     writeReport(bench.report, options.jsonPath, bench.raw, options.csvPath));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

}  // namespace

Command latencyCommand() {
  constexpr int kMaxColdMb = 1024;
  const auto request = std::make_shared<LatencyRequest>();
  request->ratesHz = {5, 10, 30};
  request->tolerances = {1e-3, 1e-5};
  Settings settings;
  addNumbers(settings, "--rate", "HZ,...", request->ratesHz, kAboveZero, "Poses a second");
  addNumbers(settings, "--tolerance", "M,...", request->tolerances, kToleranceRange,
             "Tolerances (m)");
  addSimds(settings, "--simd", request->widths, "Vector instructions: their names, all or widest");
  addLinks(settings, "--links", request->links);
  addTriangles(settings, "--triangles", request->triangles);
  settings.whole("--cold-mb", "MB", request->options.timing.coldMb, 0, kMaxColdMb,
                 "Streamed through the caches before a cold step; 0: none");
  settings.flag("--self", request->self,
                "Also with the avatar's own links, by rules from these steps' poses");
  addBenchOptions(settings, request->options);
  Command command{
      "latency", "How long a step takes, and how many sets of 16 rays that is",
      "Example:\n  foretouch-bench latency --triangles 300000 --links 16 --json latency.json",
      std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
