#include "bench/trees_command.h"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "articulated/try.h"
#include "bench/trees.h"
#include "lss/index.h"
#include "tools/arguments.h"
#include "tools/settling.h"

namespace foretouch::tools {
namespace {

struct TreesTexts : BenchTexts {
  std::string triangles = "300000", rounds = "5";
};

Result<TreesRequest> settledTrees(const TreesTexts& texts) {
  constexpr int kMaxRounds = 1000;
  TreesRequest request;
  Settling settle;
  settle.into(request.options, settled(texts));
  int triangles = 0;
  settle.into(triangles, parseOwnOrCount("--triangles", texts.triangles, kMaxBenchTriangles));
  request.triangles = countOf(triangles);
  settle.into(request.rounds, parseCount("--rounds", texts.rounds, kMaxRounds));
  if (settle.error()) return *settle.error();
  return request;
}

ExitCode run(const TreesTexts& texts) {
  FORETOUCH_TRY_OR(failed, const auto request, settledTrees(texts));
  FORETOUCH_TRY_OR(failed, const auto bench, measureTrees(request));
  FORETOUCH_CHECK_OR(failed, writeReport(bench.report, texts.json, bench.raw, texts.csv));
  printOut(reportText(bench.report));
  return ExitCode::Done;
}

}  // namespace

void addBenchTreesCommand(CLI::App& bench, ExitCode& exit) {
  const auto texts = std::make_shared<TreesTexts>();
  CLI::App* const command = bench.add_subcommand(
      "trees", "The builders of a scene's tree: how long they take, and how good their trees are");
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command->add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--triangles", texts->triangles, "N|own", "Triangles that the scene is divided into");
  option("--rounds", texts->rounds, "N", "How often each builder builds");
  addBenchOptions(*command, *texts);
  command->footer("Example:\n  foretouch-bench trees --triangles 300000 --json trees.json");
  command->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
