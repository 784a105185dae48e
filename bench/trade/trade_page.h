// bench/trade/trade_page.h: what `bench trade` measured, as one HTML page that needs nothing
// else: no network, no library, no script.
#pragma once

#include <string>

#include "bench/trade.h"

namespace foretouch::tools {

/// Three plots for each scene and clip, whose titles say what they show, and the tables.
[[nodiscard]] std::string tradePage(const MeasuredTrade& bench);

}  // namespace foretouch::tools
