// tools/inputs/name_pattern.h: which names a word of --ignore or of a policy matches.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foretouch::tools {

/// A `*` at the pattern's end matches any ending, one at its beginning any beginning, `*` alone
/// every name; otherwise names are exact.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

/// The indices of the matching names, ascending.
[[nodiscard]] std::vector<std::int32_t> matching(std::string_view pattern,
                                                 const std::vector<std::string>& names);

}  // namespace foretouch::tools
