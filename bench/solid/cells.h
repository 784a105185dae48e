// bench/solid/cells.h: numbers of solid avatars as cells of tables.
#pragma once

#include <algorithm>
#include <cstdint>

namespace foretouch::tools {

/// Millimetres per metre.
inline constexpr double kMm = 1e3;

[[nodiscard]] inline std::int64_t cell(std::uint64_t count) {
  return static_cast<std::int64_t>(count);
}
/// The share in percent; 0 if the whole is 0.
[[nodiscard]] inline double percent(std::uint64_t part, std::uint64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
}

}  // namespace foretouch::tools
