#include "bench/leaf_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/generated_queries.h"
#include "bench/leaf.h"
#include "tests/reference/rigid_query.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kMaxRepeat = 1'000'000, kMaxGenerated = 10'000'000;
constexpr double kRigidBand = 1e-3;  // metres; a common tolerance

struct LeafTexts {
  std::vector<std::string> folders;
  std::int64_t repeat = 5, generated = 0;
  std::uint64_t seed = 1;
  std::string json;
};

TimedSet timed(const QuerySet& set, int repeat, bool labelled) {
  TimedSet result{set.name, toString(set.kind), {}};
  result.leaves = timeLeaves(set.queries.size(), repeat,
                             [&](std::size_t i) { return answer(set.kind, set.queries[i]); });
  if (!labelled) return result;
  for (std::size_t i = 0; i < set.queries.size(); ++i) {
    result.leaves[i].truth = set.queries[i].hits;
  }
  return result;
}

void addGenerated(LeafBench& bench) {
  for (const QueryKind kind : {QueryKind::VertexFace, QueryKind::EdgeEdge}) {
    const QuerySet set{"generated", kind, generatedQueries(kind, bench.generated, bench.seed)};
    bench.sets.push_back(timed(set, bench.repeat, false));
  }
  const auto pairs = generatedRigidPairs(bench.generated, bench.seed);
  TimedSet rigid{"generated", "rigid pair", {}};
  rigid.leaves = timeLeaves(pairs.size(), bench.repeat, [&](std::size_t i) {
    const RigidPair& p = pairs[i];
    return rigidTrianglePair(p.motion, p.moving_L, p.fixed_W, kRigidBand).leaf;
  });
  bench.sets.push_back(std::move(rigid));
}

Result<Done> check(const LeafTexts& texts) {
  if (texts.folders.empty() && texts.generated == 0) {
    return Error::in("bench leaf", ErrorCode::Empty, "expected --queries or --generated");
  }
  if (texts.repeat < 1 || texts.repeat > kMaxRepeat) {
    return Error::in("--repeat", ErrorCode::OutOfRange,
                     fmt::format("expected 1 to {}, found {}", kMaxRepeat, texts.repeat));
  }
  if (texts.generated < 0 || texts.generated > kMaxGenerated) {
    return Error::in("--generated", ErrorCode::OutOfRange,
                     fmt::format("expected 0 to {}, found {}", kMaxGenerated, texts.generated));
  }
  return Done{};
}

Result<Done> writeJson(const std::string& path, const LeafBench& bench) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(leafJson(bench));
  return file.commit();
}

ExitCode run(const LeafTexts& texts) {
  FORETOUCH_CHECK_OR(failed, check(texts));
  LeafBench bench;
  bench.repeat = static_cast<int>(texts.repeat);
  bench.seed = texts.seed;
  bench.generated = static_cast<std::size_t>(texts.generated);
  bench.overheadUs = clockOverheadUs();
  FORETOUCH_TRY_OR(failed, const auto sets, readQuerySets(texts.folders));
  for (const QuerySet& set : sets) bench.sets.push_back(timed(set, bench.repeat, true));
  if (bench.generated > 0) addGenerated(bench);
  if (!texts.json.empty()) {
    FORETOUCH_CHECK_OR(failed, writeJson(texts.json, bench));
  }
  printOut(leafTable(bench));
  const std::size_t wrong = wrongAnswers(bench);
  if (wrong == 0) return ExitCode::Done;
  printError(fmt::format("{} answers differ from their labels", wrong));
  return ExitCode::CheckSaysNo;
}

}  // namespace

void addBenchLeafCommand(CLI::App& program, ExitCode& exit) {
  const auto texts = std::make_shared<LeafTexts>();
  CLI::App* const leaf = program.add_subcommand(
      "leaf", "Answer and time exact leaf queries; exit code 1 where an answer is not its label");
  leaf->add_option("--queries", texts->folders,
                   "Folders with query sets: CSV files in folders named vertex-face or edge-edge")
      ->type_name("FOLDER...");
  leaf->add_option("--generated", texts->generated,
                   "So many made-up queries of each kind, rigid pairs too")
      ->type_name("N")
      ->capture_default_str();
  leaf->add_option("--seed", texts->seed, "Of the made-up queries")
      ->type_name("S")
      ->capture_default_str();
  leaf->add_option("--repeat", texts->repeat, "Passes over each set; a query's least time counts")
      ->type_name("N")
      ->capture_default_str();
  leaf->add_option("--json", texts->json, "Also write the figures to a file")->type_name("FILE");
  leaf->footer(
      "Example:\n  foretouch-bench leaf --queries sample-queries --repeat 10 --json leaf.json");
  leaf->callback([texts, &exit] { exit = run(*texts); });
}

}  // namespace foretouch::tools
