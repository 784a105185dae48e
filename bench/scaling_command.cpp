#include "bench/scaling_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/scaling.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct ScalingTexts : BenchTexts {
  std::string triangles, links, rate, tolerance, avatars, threads;
  std::string baseTriangles, baseLinks = "16", baseRate = "5", baseTolerance = "0.001";
  bool quick = false;
};

/// "none" omits an axis; an empty text means the usual values.
template <typename Values>
void settleAxis(Settling& settle, Values& values, const std::string& text,
                const Result<Values>& parsed) {
  if (text == "none") {
    values.clear();
  } else {
    settle.into(values, parsed);
  }
}

/// The usual lists, or short ones for a quick run.
void fillIn(ScalingTexts& texts) {
  const auto usual = [&](std::string& text, const char* full, const char* quick) {
    if (text.empty()) text = texts.quick ? quick : full;
  };
  usual(texts.triangles, "10000,300000,1000000,3000000,10000000", "none");
  usual(texts.links, "1,4,16,31,64,128", "8,16");
  usual(texts.rate, "1,5,10,30", "10");
  usual(texts.tolerance, "0.01,0.001,0.0001,0.00001", "0.00001");
  usual(texts.avatars, "1,10,100", "3");
  usual(texts.threads, "1,2", "1,2");
  usual(texts.baseTriangles, "300000", "own");
}

Result<ScalingRequest> settledScaling(ScalingTexts texts) {
  constexpr int kQuickSteps = 40, kQuickRepeats = 2, kQuickCrowd = 60;
  fillIn(texts);
  ScalingRequest request;
  Settling settle;
  settle.into(request.options, settled(texts));
  int triangles = 0;
  settle.into(triangles,
              parseOwnOrCount("--base-triangles", texts.baseTriangles, kMaxBenchTriangles));
  request.triangles = countOf(triangles);
  settle.into(request.links, parseOwnOrCount("--base-links", texts.baseLinks, kMaxBenchLinks));
  settle.into(request.rateHz, parsePositive("--base-rate", texts.baseRate));
  settle.into(request.tolerance, parseTolerance("--base-tolerance", texts.baseTolerance));
  settleAxis(settle, request.trianglesAxis, texts.triangles,
             parseCounts("--triangles", texts.triangles, kMaxBenchTriangles));
  settleAxis(settle, request.linksAxis, texts.links,
             parseCounts("--links", texts.links, kMaxBenchLinks));
  settleAxis(settle, request.rateAxis, texts.rate, parsePositives("--rate", texts.rate));
  settleAxis(settle, request.toleranceAxis, texts.tolerance,
             parseTolerances("--tolerance", texts.tolerance));
  settleAxis(settle, request.avatarsAxis, texts.avatars,
             parseCounts("--avatars", texts.avatars, kMaxBenchAvatars));
  settleAxis(settle, request.threadsAxis, texts.threads,
             parseCounts("--threads", texts.threads, kMaxThreads));
  if (settle.error()) return *settle.error();
  if (texts.quick) {
    request.options.workload.steps =
        std::min<std::size_t>(request.options.workload.steps, kQuickSteps);
    request.options.timing.repeats = kQuickRepeats;
    request.crowdSteps = kQuickCrowd;
  }
  return request;
}

ExitCode run(const ScalingTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledScaling(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureScaling(request));
  FORETOUCH_CHECK_OR(failed, writeReport(bench.report, texts.json, bench.raw, texts.csv));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

constexpr char kFooter[] =
    R"(An axis of `none` is left out. The base is what stays while one axis is varied.
Examples:
  foretouch-bench scaling --quick
  foretouch-bench scaling --triangles 300000,3000000 --links 16,64 --json scaling.json)";

}  // namespace

void addBenchScalingCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<ScalingTexts>();
  CLI::App* const command = bench.add_subcommand(
      "scaling", "How a step's cost grows with triangles, links, motion, tolerance and avatars");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--triangles", texts->triangles, "N,...", "Triangles that the scene is divided into");
  option("--links", texts->links, "N,...", "Links: fewer are cut off, more are grown");
  option("--rate", texts->rate, "HZ,...", "Poses a second");
  option("--tolerance", texts->tolerance, "M,...", "Tolerances (m)");
  option("--avatars", texts->avatars, "N,...", "Avatars in the scene at once");
  option("--threads", texts->threads, "N,...", "Threads that answer them");
  option("--base-triangles", texts->baseTriangles, "N|own", "While other things are varied");
  option("--base-links", texts->baseLinks, "N|own", "While other things are varied");
  option("--base-rate", texts->baseRate, "HZ", "While other things are varied");
  option("--base-tolerance", texts->baseTolerance, "M", "While other things are varied");
  command->add_flag("--quick", texts->quick, "Few values and steps: a trial of seconds");
  addBenchOptions(*command, *texts);
  command->footer(kFooter);
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
