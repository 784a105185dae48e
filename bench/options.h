// bench/options.h: the options that `foretouch-bench latency` and `scaling` share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"
#include "bench/timing.h"
#include "bench/workload.h"
#include "lss/simd.h"
#include "middleware/query/query.h"
#include "tests/reference/reference_query.h"

namespace CLI {
class App;
}

namespace foretouch::tools {

/// Values as typed in.
struct BenchTexts {
  std::string scene, motion, avatar, map, skin, place, json, csv;
  std::string sceneScale = "1", scale = "1", up = "y", motionUp = "y", floor = "0", lift = "0.05";
  std::string steps = "500", seed = "1", places = "1000", repeat = "9", processor = "any",
              choice = "busy";
  std::string fidelity = "link", descent = "straight", leaves = "advancement", culler = "flat",
              surfaceTriangles = "20000";
};

/// The same, checked.
struct BenchOptions {
  BenchFiles files;
  WorkloadRequest workload;
  TimingOptions timing;
  Fidelity fidelity = Fidelity::Link;
  ReferenceOptions reference;
  std::size_t surfaceTriangles = 20'000;
  std::string skinPath;  ///< Not empty at skinned fidelity.
  std::optional<int> processor;
  std::string jsonPath, csvPath;
  std::string command;  ///< As typed in.
};

inline constexpr int kMaxBenchSteps = 1'000'000, kMaxBenchRepeats = 10'000;
inline constexpr int kMaxBenchTriangles = 50'000'000, kMaxBenchAvatars = 10'000;

void addBenchOptions(CLI::App& command, BenchTexts& texts);
/// Errors name the option.
[[nodiscard]] Result<BenchOptions> settled(const BenchTexts& texts);

/// Comma-separated values, each by its own rule; at least one.
[[nodiscard]] Result<std::vector<double>> parsePositives(const std::string& option,
                                                         const std::string& text);
[[nodiscard]] Result<std::vector<double>> parseTolerances(const std::string& option,
                                                          const std::string& text);
[[nodiscard]] Result<std::vector<int>> parseCounts(const std::string& option,
                                                   const std::string& text, int most);
/// A whole number from 1 to `most`, or 0 for the word "own".
[[nodiscard]] Result<int> parseOwnOrCount(const std::string& option, const std::string& text,
                                          int most);
/// Names of lss/simd.h, "all" (widest first) or "widest". Refuses those that this processor lacks.
[[nodiscard]] Result<std::vector<Simd>> parseSimds(const std::string& option,
                                                   const std::string& text);

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

/// Scene, avatar, clip, surface and what of `reference` is not the product's, in words.
[[nodiscard]] std::vector<BenchFact> workloadFacts(const BenchInputs& inputs, const Scene& scene,
                                                   const Avatar& avatar, const QueryOptions& query,
                                                   const ReferenceOptions& reference = {});

}  // namespace foretouch::tools
