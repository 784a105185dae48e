// tools/settings/plain_figures.h: lengths as people write them, however large or small.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace foretouch::tools {

/// The value as `{:.3g}`, but without an exponent: "123000", "0.0000123".
[[nodiscard]] inline std::string plainFigures(double value) {
  std::string text = fmt::format("{:.3g}", value);
  if (text.find('e') == text.npos) return text;
  const auto exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const double unit = std::pow(10.0, exponent - 2);
  return fmt::format("{:.{}f}", exponent > 2 ? std::round(value / unit) * unit : value,
                     std::max(0, 2 - exponent));
}

}  // namespace foretouch::tools
