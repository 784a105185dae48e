// tools/inputs/ignored_pairs.h: the texts of --ignore as pairs of links and objects.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/query/query.h"

namespace foretouch::tools {

/// Limit on the pairs of all texts together: a query searches them all.
inline constexpr std::size_t kMaxIgnoredPairs = 100'000;

/// Each text is a list of `link` or `link:object`, separated by commas. Names are exact or patterns
/// (tools/inputs/name_pattern.h). If names contain colons, the reading that matches counts; errors:
/// two readings that match, and names that match nothing (with the nearest existing ones). Sorted
/// and without repetitions.
[[nodiscard]] Result<std::vector<IgnoredPair>> parseIgnoredPairs(
    const std::vector<std::string>& texts, const Skeleton& skeleton,
    const std::vector<std::string>& objectNames);

}  // namespace foretouch::tools
