// tests/oracle/sweep.h: runs the product on many steps of a real clip in a real scene; the oracle
// judges every answer about links and the scene, or about the body's own links.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "articulated/pair_rules.h"
#include "tests/oracle/sweep_inputs.h"
#include "tests/reference/reference_query.h"

namespace foretouch::test {

struct SweepOptions {
  double rateHz = 10.0;
  double tolerance = 1e-3;
  int maxSteps = 200;  ///< Spread evenly over the clip, its first step included.
  int threads = 1;
  ReferenceOptions reference;  ///< With a rung, for clips without a surface: judges its volumes.
  std::uint64_t workBudget = QueryOptions{}.workBudget;
  double deadlineUs = QueryOptions{}.deadlineUs;
  /// For models: Skinned asks and judges their skins.
  Fidelity fidelity = Fidelity::Link;
  /// Asks whether own links touch each other, and judges that instead.
  std::optional<PairRules> self;
  std::optional<std::chrono::steady_clock::time_point> deadline;
  /// Applied to every answer before the judge: for controls that plant lies.
  std::function<void(LinkContact&)> tamper;
  std::function<void(std::vector<PairContact>&)> tamperWithPairs;
};

struct SweepTally {
  static constexpr std::size_t kFindings = 7, kVerdicts = 4;
  /// Judged: links with a surface, or asked pairs of links, once per step.
  std::uint64_t steps = 0, judged = 0;
  std::array<std::uint64_t, kVerdicts> verdicts{};
  std::array<std::uint64_t, kFindings> findings{};
  std::uint64_t failedQueries = 0;
  std::uint64_t grazing = 0, looks = 0;
  double querySeconds = 0.0, judgeSeconds = 0.0;  ///< Summed over threads.
  double slowestQueryS = 0.0, slowestJudgementS = 0.0;
  std::vector<std::string> violations;  ///< Everything needed to replay one; the first twenty.
  bool outOfTime = false;

  void add(const SweepTally& other);
  [[nodiscard]] std::uint64_t of(oracle::Verdict v) const {
    return verdicts[static_cast<std::size_t>(v)];
  }
  [[nodiscard]] std::uint64_t of(oracle::Finding f) const {
    return findings[static_cast<std::size_t>(f)];
  }
  /// Broken promises. An unproved judgement is not one, but appears beside them.
  [[nodiscard]] std::uint64_t broken() const;
  /// One line of counts.
  [[nodiscard]] std::string summary() const;
};

[[nodiscard]] SweepTally sweep(const SweepClip& clip, const SweepScene& scene,
                               const Placement& placement, const SweepOptions& options);

}  // namespace foretouch::test
