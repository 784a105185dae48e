#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/options.h"
#include "bench/trees.h"

namespace foretouch::tools {
namespace {

ExitCode run(TreesRequest& request) {
  BenchOptions& options = request.options;
  FORETOUCH_CHECK_OR(failed, complete(options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrees(request));
  FORETOUCH_CHECK_OR(failed,
                     writeReport(bench.report, options.jsonPath, bench.raw, options.csvPath));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

}  // namespace

Command treesCommand() {
  constexpr int kMaxRounds = 1000;
  const auto request = std::make_shared<TreesRequest>();
  Settings settings;
  addTriangles(settings, "--triangles", request->triangles);
  settings.whole("--rounds", "N", request->rounds, 1, kMaxRounds, "How often each builder builds");
  addBenchOptions(settings, request->options);
  Command command{
      "trees", "The builders of a scene's tree: how long they take, and how good their trees are",
      "Example:\n  foretouch-bench trees --triangles 300000 --json trees.json",
      std::move(settings)};
  command.run = [request](const Settings&) { return run(*request); };
  return command;
}

}  // namespace foretouch::tools
