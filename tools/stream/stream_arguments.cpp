#include "tools/stream/stream_arguments.h"

#include <cmath>

#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/stream/serve_config.h"

namespace foretouch::tools {

Result<std::int64_t> parseMaxStepUs(const std::string& option, const std::string& text) {
  constexpr double kUsPerS = 1e6;
  const auto seconds = parsePositive(option, text);
  if (!seconds.ok()) return seconds.error();
  if (seconds.value() <= kMaxServeStepS && seconds.value() * kUsPerS >= 1.0) {
    return static_cast<std::int64_t>(std::llround(seconds.value() * kUsPerS));
  }
  return Error{ErrorCode::OutOfRange, option, -1, -1,
               "expected seconds from 0.000001 to 86400, found " + inQuotes(text)};
}

Result<std::int64_t> parseBudgetUs(const std::string& option, const std::string& text) {
  const auto count = parseCount(option, text, static_cast<int>(kMaxServeBudgetUs));
  if (!count.ok()) return count.error();
  return std::int64_t{count.value()};
}

}  // namespace foretouch::tools
