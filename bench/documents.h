// bench/documents.h: documents made from benchmark files: docs/performance.md, and what has
// moved since the recorded instruction counts.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

inline constexpr std::size_t kMaxReportBytes = std::size_t{64} << 20;

[[nodiscard]] Result<BenchReport> readReport(const std::string& path);

/// docs/performance.md: a section a report, in the order given.
[[nodiscard]] std::string performanceDocument(const std::vector<BenchReport>& reports);

/// The "totals" or "summary" line of a callgrind file: instructions of what it collected.
[[nodiscard]] Result<std::int64_t> callgrindInstructions(const std::string& text,
                                                         const std::string& name);

/// A report with one table, "quantities": instructions a step, and the mean counters of the first
/// case of a latency report. Error where `latency` holds no such table.
[[nodiscard]] Result<BenchReport> instructionReport(const BenchReport& latency,
                                                    std::int64_t instructions);

/// Each quantity before and now, and by how many percent it moved. Quantities that only one side
/// has are shown with a gap.
[[nodiscard]] BenchTable movedTable(const BenchReport& recorded, const BenchReport& now);

}  // namespace foretouch::tools
