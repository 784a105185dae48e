// bench/trade/trade_tables.h: the measurements as tables: all of them for files, and a selection
// for people.
#pragma once

#include <string>
#include <vector>

#include "bench/report.h"
#include "bench/trade/trade_row.h"

namespace foretouch::tools {

/// Every figure of every row; `name` is the table's.
[[nodiscard]] BenchTable tradeTable(const std::vector<TradeRow>& rows, const std::string& name,
                                    const std::string& title);

/// Foretouch's lead in each scene and clip; every strategy over all scenes and clips; misses at
/// each rate; the frontiers. At this tolerance and this rate, except for the varied one.
[[nodiscard]] std::vector<BenchTable> tablesForPeople(const std::vector<TradeRow>& rows,
                                                      double tolerance, double rateHz);

}  // namespace foretouch::tools
