// bench/trade/trade_tables.h: what was measured, as tables: all of it for files, and what a
// person asks for.
#pragma once

#include <string>
#include <vector>

#include "bench/report.h"
#include "bench/trade/trade_row.h"

namespace foretouch::tools {

/// Every figure of every row; `name` is the table's.
[[nodiscard]] BenchTable tradeTable(const std::vector<TradeRow>& rows, const std::string& name,
                                    const std::string& title);

/// By how much Foretouch leads in each scene and clip; every strategy, all scenes and clips
/// together; what is missed at each rate; the frontiers. At this tolerance and this rate, but for
/// what is looked at.
[[nodiscard]] std::vector<BenchTable> tablesForPeople(const std::vector<TradeRow>& rows,
                                                      double tolerance, double rateHz);

}  // namespace foretouch::tools
