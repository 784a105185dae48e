// bench/options.h: the options that several commands of `foretouch-bench` have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "middleware/query/query.h"
#include "tests/reference/reference_query.h"
#include "tools/console.h"
#include "tools/settings/settings.h"

namespace foretouch::tools {

/// What a benchmark of queries is about.
struct BenchOptions {
  BenchFiles files;
  WorkloadRequest workload;
  TimingOptions timing;
  std::string touching = "link";  ///< As named; complete() makes it the next two.
  Fidelity fidelity = Fidelity::Link;
  ReferenceOptions reference;
  std::size_t surfaceTriangles = 20'000;
  std::string skinPath;  ///< Not empty at skinned fidelity.
  std::optional<int> processor;
  FigureFiles figures;
};

inline constexpr int kMaxBenchSteps = 1'000'000, kMaxBenchRepeats = 10'000;
inline constexpr int kMaxBenchTriangles = 50'000'000, kMaxBenchAvatars = 10'000;

/// Adds all of them; `options` outlives the settings. Then complete() them.
void addBenchOptions(Settings& settings, BenchOptions& options);
/// Takes apart what touches, and keeps to the processor. Errors name the option.
[[nodiscard]] Result<Done> complete(BenchOptions& options);

/// --scene, --motion, --avatar, --map, and their units and axes.
void addBenchFiles(Settings& settings, BenchFiles& files);
/// --json and --csv.
void addFigures(Settings& settings, FigureFiles& files, const char* inCsv);
/// --floor and --lift.
void addFloor(Settings& settings, WorkloadRequest& workload);
/// --processor; then keepTo() it.
void addProcessor(Settings& settings, std::optional<int>& processor);
[[nodiscard]] Result<Done> keepTo(const std::optional<int>& processor);
/// --links and --triangles of the scene: 0 for the word "own".
void addLinks(Settings& settings, const char* option, int& links);
void addTriangles(Settings& settings, const char* option, std::size_t& triangles);

/// The end of a command: its report in files and on the terminal. `fault`: what the benchmark found
/// wrong, in words; empty: nothing.
[[nodiscard]] ExitCode finished(const BenchReport& report, const BenchTable& raw,
                                const FigureFiles& files, const std::string& fault = {});
/// The same, its first table as CSV, with a judge's findings: how many, then `fault`.
[[nodiscard]] ExitCode finished(const JudgedReport& bench, const std::string& fault,
                                const FigureFiles& files);
/// Is it among those that were named? Each is, if none was named.
[[nodiscard]] bool isAsked(const std::vector<std::string>& named, const std::string& one);

/// --data: the folder of clips and scenes, by default $FORETOUCH_DATA, else ../shared/data.
void addData(Settings& settings, std::string& folder, const char* help);

/// The options of a body's query for the fidelity: at exact fidelity with its triangles, from the
/// avatar file if the body is that avatar and it has some, else the skins of its LSS; at skinned
/// fidelity with the skin of the model, whose avatar the body must be.
[[nodiscard]] Result<QueryOptions> queryFor(const BenchInputs& inputs, const BenchBody& body,
                                            const BenchOptions& options);

/// The inputs' scene, refined to `triangles` if it has fewer; 0: unchanged.
[[nodiscard]] Result<Scene> refinedScene(const BenchInputs& inputs, std::size_t triangles);
/// The inputs' avatar with `links` links; 0: its own.
[[nodiscard]] Result<BenchBody> bodyOf(const BenchInputs& inputs, int links);

/// What touches: "link", or "limb" where the reference room asks that.
[[nodiscard]] const char* fidelityWord(Fidelity fidelity, const ReferenceOptions& reference);

/// Scene, avatar, clip, surface and what in `reference` is not the product's, in words.
[[nodiscard]] std::vector<BenchFact> workloadFacts(const BenchInputs& inputs, const Scene& scene,
                                                   const Avatar& avatar, const QueryOptions& query,
                                                   const ReferenceOptions& reference = {});

}  // namespace foretouch::tools
