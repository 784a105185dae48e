#include "bench/latency_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/latency.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct LatencyTexts : BenchTexts {
  std::string rate = "5,10,30", tolerance = "0.001,0.00001", simd = "all", links = "own",
              triangles = "own", coldMb = "16";
  bool self = false;
};

Result<LatencyRequest> settledLatency(const LatencyTexts& texts) {
  constexpr int kMaxColdMb = 1024;
  LatencyRequest request;
  Settling settle;
  settle.into(request.options, settled(texts));
  settle.into(request.ratesHz, parsePositives("--rate", texts.rate));
  settle.into(request.tolerances, parseTolerances("--tolerance", texts.tolerance));
  settle.into(request.widths, parseSimds("--simd", texts.simd));
  settle.into(request.links, parseOwnOrCount("--links", texts.links, kMaxBenchLinks));
  int triangles = 0;
  settle.into(triangles, parseOwnOrCount("--triangles", texts.triangles, kMaxBenchTriangles));
  request.triangles = countOf(triangles);
  request.options.timing.coldMb = 0;
  if (texts.coldMb != "0") {
    settle.into(request.options.timing.coldMb, parseCount("--cold-mb", texts.coldMb, kMaxColdMb));
  }
  request.self = texts.self;
  if (settle.error()) return *settle.error();
  return request;
}

ExitCode run(const LatencyTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledLatency(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureLatency(request));
  FORETOUCH_CHECK_OR(failed, writeReport(bench.report, texts.json, bench.raw, texts.csv));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

}  // namespace

void addBenchLatencyCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<LatencyTexts>();
  CLI::App* const command = bench.add_subcommand(
      "latency", "How long a step takes, and how many sets of 16 rays that is");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--rate", texts->rate, "HZ,...", "Poses a second");
  option("--tolerance", texts->tolerance, "M,...", "Tolerances (m)");
  option("--simd", texts->simd, "NAME,...", "Vector instructions: their names, all or widest");
  option("--links", texts->links, "N|own", "Links: fewer are cut off, more are grown");
  option("--triangles", texts->triangles, "N|own", "Triangles that the scene is divided into");
  option("--cold-mb", texts->coldMb, "MB",
         "Streamed through the caches before a cold step; 0: none");
  command->add_flag("--self", texts->self,
                    "Also with the avatar's own links, by rules from these steps' poses");
  addBenchOptions(*command, *texts);
  command->footer(
      "Example:\n  foretouch-bench latency --triangles 300000 --links 16 --json latency.json");
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
