#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "bench/commands.h"
#include "bench/generated_queries.h"
#include "bench/leaf.h"
#include "tests/reference/rigid_query.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kMaxRepeat = 1'000'000, kMaxGenerated = 10'000'000;
constexpr double kRigidBand = 1e-3;  // metres; a common tolerance

struct AskedLeaves {
  std::vector<std::string> folders;
  int repeat = 5;
  std::size_t generated = 0;
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

Result<Done> writeJson(const std::string& path, const LeafBench& bench) {
  FORETOUCH_TRY(auto file, PendingFile::create(path));
  file.write(leafJson(bench));
  return file.commit();
}

ExitCode run(const AskedLeaves& asked) {
  if (asked.folders.empty() && asked.generated == 0) {
    return failed(Error::in("bench leaf", ErrorCode::Empty, "expected --queries or --generated"));
  }
  LeafBench bench;
  bench.repeat = asked.repeat;
  bench.seed = asked.seed;
  bench.generated = asked.generated;
  bench.overheadUs = clockOverheadUs();
  FORETOUCH_TRY_OR(failed, const auto sets, readQuerySets(asked.folders));
  for (const QuerySet& set : sets) bench.sets.push_back(timed(set, bench.repeat, true));
  if (bench.generated > 0) addGenerated(bench);
  if (!asked.json.empty()) {
    FORETOUCH_CHECK_OR(failed, writeJson(asked.json, bench));
  }
  printOut(leafTable(bench));
  const std::size_t wrong = wrongAnswers(bench);
  if (wrong == 0) return ExitCode::Done;
  printError(fmt::format("{} answers differ from their labels", wrong));
  return ExitCode::CheckSaysNo;
}

}  // namespace

Command leafCommand() {
  const auto asked = std::make_shared<AskedLeaves>();
  Settings settings;
  settings.list("--queries", "FOLDER", asked->folders,
                "Folder with query sets: CSV files in folders named vertex-face or edge-edge; may "
                "be repeated");
  settings.whole("--generated", "N", asked->generated, 0, kMaxGenerated,
                 "So many made-up queries of each kind, rigid pairs too");
  settings.whole("--seed", "S", asked->seed, 0, std::numeric_limits<std::int64_t>::max(),
                 "Of the made-up queries");
  settings.whole("--repeat", "N", asked->repeat, 1, kMaxRepeat,
                 "Passes over each set; a query's least time counts");
  settings.output("--json", "FILE", asked->json, "Also write the figures to a file");
  Command command{
      "leaf", "Answer and time exact leaf queries; exit code 1 where an answer is not its label",
      "Example:\n  foretouch-bench leaf --queries sample-queries --repeat 10 --json leaf.json",
      std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
