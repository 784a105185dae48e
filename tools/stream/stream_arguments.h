// tools/stream/stream_arguments.h: option values of streams, as typed in, checked. Errors name the
// option, what was expected and what was found.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/result.h"

namespace foretouch::tools {

/// StreamPolicy::maxStepUs from seconds: a microsecond to a day.
[[nodiscard]] Result<std::int64_t> parseMaxStepUs(const std::string& option,
                                                  const std::string& text);

/// ServeConfig::budgetUs.
[[nodiscard]] Result<std::int64_t> parseBudgetUs(const std::string& option,
                                                 const std::string& text);

}  // namespace foretouch::tools
