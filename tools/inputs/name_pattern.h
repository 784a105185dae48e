// tools/inputs/name_pattern.h: which names a word of --ignore or of a policy stands for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foretouch::tools {

/// A `*` at the pattern's end stands for any ending, one at its beginning for any beginning, `*`
/// alone for every name; otherwise names are exact.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

/// The indices of the names that it stands for, ascending.
[[nodiscard]] std::vector<std::int32_t> matching(std::string_view pattern,
                                                 const std::vector<std::string>& names);

}  // namespace foretouch::tools
