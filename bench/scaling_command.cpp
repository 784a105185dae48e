#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "bench/commands.h"
#include "tools/settings/lists.h"
#include "bench/options.h"
#include "bench/scaling.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct AskedScaling {
  ScalingRequest request;
  bool quick = false;
};

/// Short lists where the command line has none, and few steps.
void makeQuick(const Settings& settings, ScalingRequest& request) {
  constexpr int kQuickSteps = 40, kQuickRepeats = 2, kQuickCrowd = 60;
  const auto quick = [&](const char* option, auto& place, auto values) {
    if (!settings.isGiven(option)) place = std::move(values);
  };
  quick("--triangles", request.trianglesAxis, std::vector<int>{});
  quick("--links", request.linksAxis, std::vector<int>{8, 16});
  quick("--rate", request.rateAxis, std::vector<double>{10});
  quick("--tolerance", request.toleranceAxis, std::vector<double>{1e-5});
  quick("--avatars", request.avatarsAxis, std::vector<int>{3});
  quick("--base-triangles", request.triangles, std::size_t{0});
  request.options.workload.steps =
      std::min<std::size_t>(request.options.workload.steps, kQuickSteps);
  request.options.timing.repeats = kQuickRepeats;
  request.crowdSteps = kQuickCrowd;
}

ExitCode run(const Settings& settings, AskedScaling& asked) {
  BenchOptions& options = asked.request.options;
  if (asked.quick) makeQuick(settings, asked.request);
  FORETOUCH_CHECK_OR(failed, complete(options));
  FORETOUCH_TRY_OR(failed, const auto bench, measureScaling(asked.request));
  FORETOUCH_CHECK_OR(failed,
                     writeReport(bench.report, options.jsonPath, bench.raw, options.csvPath));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

void addAxes(Settings& settings, ScalingRequest& request) {
  request.trianglesAxis = {10'000, 300'000, 1'000'000, 3'000'000, 10'000'000};
  request.linksAxis = {1, 4, 16, 31, 64, 128};
  request.rateAxis = {1, 5, 10, 30};
  request.toleranceAxis = {1e-2, 1e-3, 1e-4, 1e-5};
  request.avatarsAxis = {1, 10, 100};
  request.threadsAxis = {1, 2};
  const auto counts = [&](const char* option, std::vector<int>& place, int most, const char* help) {
    orNone(addCounts(settings, option, "N,...", place, most, help), place);
  };
  const auto numbers = [&](const char* option, const char* value, std::vector<double>& place,
                           NumberRange range, const char* help) {
    orNone(addNumbers(settings, option, value, place, range, help), place);
  };
  counts("--triangles", request.trianglesAxis, kMaxBenchTriangles,
         "Triangles that the scene is divided into");
  counts("--links", request.linksAxis, kMaxBenchLinks, "Links: fewer are cut off, more are grown");
  numbers("--rate", "HZ,...", request.rateAxis, kAboveZero, "Poses a second");
  numbers("--tolerance", "M,...", request.toleranceAxis, kToleranceRange, "Tolerances (m)");
  counts("--avatars", request.avatarsAxis, kMaxBenchAvatars, "Avatars in the scene at once");
  counts("--threads", request.threadsAxis, kMaxThreads, "Threads that answer them");
}

constexpr char kFooter[] =
    R"(An axis of `none` is left out. The base is what stays while one axis is varied.
Examples:
  foretouch-bench scaling --quick
  foretouch-bench scaling --triangles 300000,3000000 --links 16,64 --json scaling.json)";

}  // namespace

Command scalingCommand() {
  const auto asked = std::make_shared<AskedScaling>();
  ScalingRequest& request = asked->request;
  Settings settings;
  addAxes(settings, request);
  constexpr char kBase[] = "While other things are varied";
  settings.wholeOr("own", "--base-triangles", "N|own", request.triangles, kMaxBenchTriangles,
                   kBase);
  settings.wholeOr("own", "--base-links", "N|own", request.links, kMaxBenchLinks, kBase);
  settings.number("--base-rate", "HZ", request.rateHz, kAboveZero, kBase);
  settings.number("--base-tolerance", "M", request.tolerance, kToleranceRange, kBase);
  settings.flag("--quick", asked->quick, "Few values and steps: a trial of seconds");
  addBenchOptions(settings, request.options);
  Command command{"scaling",
                  "How a step's cost grows with triangles, links, motion, tolerance and avatars",
                  kFooter, std::move(settings)};
  command.run = [asked](const Settings& given) { return run(given, *asked); };
  return command;
}

}  // namespace foretouch::tools
