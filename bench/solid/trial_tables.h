// bench/solid/trial_tables.h: the trials of solid avatars, run and as tables.
#pragma once

#include <cstdint>

#include "articulated/result.h"
#include "bench/report.h"
#include "bench/solid/hands_trial.h"
#include "bench/solid/rest_trial.h"

namespace foretouch::tools {

struct TrialRequest {
  SolidOptions options;
  std::uint64_t boardTrials = 10'000;  ///< For the solid hand, in all.
  std::uint64_t engineTrials = 200;    ///< For each other hand and each cell of the board.
  int goals = 1000;                    ///< Among clutter.
  std::uint64_t seed = 1;
};

[[nodiscard]] Result<JudgedTable> boardTable(const TrialRequest& request);
[[nodiscard]] Result<JudgedTable> boardsTable(const TrialRequest& request);
[[nodiscard]] Result<JudgedTable> clutterTable(const TrialRequest& request);
[[nodiscard]] Result<JudgedTable> slideTable(const TrialRequest& request);
[[nodiscard]] Result<JudgedTable> pressTable(const TrialRequest& request);
[[nodiscard]] Result<JudgedTable> fingersTable(const TrialRequest& request);

/// Figures for one scene at one rate; tables of several of them have the same columns.
struct SceneRow {
  std::string scene;
  double rateHz = 0.0;
};
[[nodiscard]] BenchTable emptyRestTable();
void addRow(const SceneRow& row, const RestTally& tally, BenchTable& table);
[[nodiscard]] BenchTable emptyHandsTable();
void addRows(const SceneRow& row, const std::vector<HandsTally>& tallies, BenchTable& table);

}  // namespace foretouch::tools
