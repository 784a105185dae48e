// tools/csv_cell.h: text as a cell of a table (CSV).
#pragma once

#include <string>
#include <string_view>

namespace foretouch::tools {

/// In quotes where it must be. What a spreadsheet would take for a formula has a ' before it.
[[nodiscard]] std::string csvCell(std::string_view given);

}  // namespace foretouch::tools
