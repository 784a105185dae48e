// tools/percentile.h: the value at a rank, for summaries.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace foretouch::tools {

/// The value at or below which `share` (in [0,1]) of the values lie, by nearest rank; 0 if there
/// are none. Reorders `values`.
template <typename Number>
[[nodiscard]] double percentile(std::vector<Number>& values, double share) {
  if (values.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  const auto at =
      static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

}  // namespace foretouch::tools
