// tools/microseconds.h: the unit of timestamps.
#pragma once

namespace foretouch::tools {

inline constexpr double kUsPerS = 1e6;

}  // namespace foretouch::tools
