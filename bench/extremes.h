// bench/extremes.h: `foretouch-bench extremes`: inputs at and beyond the limits of legal input,
// with every answer compared with an oracle of fifty digits. docs/extremes.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/extremes/families.h"
#include "bench/extremes/judge.h"
#include "bench/report.h"

namespace foretouch::tools {

struct ExtremesRequest {
  std::int64_t cases = 100;       ///< Per family; costly ones take their share.
  std::uint64_t seed = 1;         ///< Of each family's first case; the next case has the next seed.
  std::vector<std::string> only;  ///< Families; empty: all.
  extremes::ExtremeSizes sizes;
};

struct ExtremesBench {
  BenchReport report;
  std::vector<extremes::Tally> tallies;      ///< One per family, like the table's rows.
  std::vector<extremes::Finding> findings;   ///< At most some dozens.
  std::vector<extremes::ExtremeCase> worst;  ///< Cases named in the table and the findings.
  bool isSound = true;                       ///< No failure (extremes::isFailure).
};

/// Errors: an unknown family. Sets the process's vector width: one at a time.
[[nodiscard]] Result<ExtremesBench> measureExtremes(const ExtremesRequest& request);

/// Families and what is extreme in them, one line each.
[[nodiscard]] std::string familiesText();

}  // namespace foretouch::tools
