// tools/replay/summary_json.h: the summary of a replay for programs (docs/formats.md, "Summaries as
// JSON").
#pragma once

#include <string>

#include "tools/replay/summary.h"

namespace foretouch::tools {

/// One line. `output` and `report`: the files written; an empty report: none.
[[nodiscard]] std::string summaryLine(const ReplaySummary& summary, int threads,
                                      const std::string& output, const std::string& report);

}  // namespace foretouch::tools
