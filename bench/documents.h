// bench/documents.h: what is made of benchmark files: the counts of instructions, and how they have
// moved since they were recorded.
#pragma once

#include <string>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxReportBytes = std::size_t{64} << 20;

[[nodiscard]] Result<BenchReport> readReport(const std::string& path);

/// The "totals" or "summary" line of a callgrind file: the instructions collected.
[[nodiscard]] Result<std::int64_t> callgrindInstructions(const std::string& text,
                                                         const std::string& name);

/// A report with one table, "quantities": instructions per step, and the mean counters of the first
/// case of a latency report. Error if `latency` has no such table.
[[nodiscard]] Result<BenchReport> instructionReport(const BenchReport& latency,
                                                    std::int64_t instructions);

/// Each quantity before and now, and its change in percent. Shows quantities that only one side has
/// with a gap.
[[nodiscard]] BenchTable movedTable(const BenchReport& recorded, const BenchReport& now);

}  // namespace foretouch::tools
