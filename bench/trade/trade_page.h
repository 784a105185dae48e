// bench/trade/trade_page.h: the results of `bench trade` as one self-contained HTML page: no
// network, no library, no script.
#pragma once

#include <string>

#include "bench/trade.h"

namespace foretouch::tools {

/// Three plots for each scene and clip, titled with what they show, and the tables.
[[nodiscard]] std::string tradePage(const MeasuredTrade& bench);

}  // namespace foretouch::tools
