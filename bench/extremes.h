// bench/extremes.h: `foretouch-bench extremes`: inputs at the edge of what is legal and
// beyond it, every answer held against an oracle of fifty digits. docs/extremes.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/extremes/families.h"
#include "bench/extremes/judge.h"
#include "bench/report.h"

namespace foretouch::tools {

struct ExtremesRequest {
  std::int64_t cases = 100;       ///< A family; costly ones take their share of it.
  std::uint64_t seed = 1;         ///< Of each family's first case; the next has the next one.
  std::vector<std::string> only;  ///< Families; empty: all.
  extremes::ExtremeSizes sizes;
  std::string command;  ///< As typed in.
};

struct ExtremesBench {
  BenchReport report;
  std::vector<extremes::Tally> tallies;      ///< One a family, as the table's rows.
  std::vector<extremes::Finding> findings;   ///< What is wrong, at most some dozens.
  std::vector<extremes::ExtremeCase> worst;  ///< Cases that the table and the findings name.
  bool isSound = true;                       ///< No failure (extremes::isFailure).
};

/// Errors: a family that there is not. Uses the process's vector width: one at a time.
[[nodiscard]] Result<ExtremesBench> measureExtremes(const ExtremesRequest& request);

/// Families and what is extreme in them, a line each.
[[nodiscard]] std::string familiesText();

}  // namespace foretouch::tools
