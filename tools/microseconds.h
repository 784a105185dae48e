// tools/microseconds.h: the unit of instants, and how seconds become it. Everything is compared in
// whole microseconds: seconds are what people write and read.
#pragma once

#include <cmath>
#include <cstdint>

#include "articulated/track.h"

namespace foretouch::tools {

inline constexpr double kUsPerS = 1e6;

/// Instants that people write are within this of zero (s), as those of tracks are.
inline constexpr double kMostTimeS = static_cast<double>(kMostUtimeUs) / kUsPerS;
inline constexpr char kTimeInWords[] = "a number of seconds within 285 years of zero";
[[nodiscard]] inline bool isTime(double seconds) {
  return std::abs(seconds) <= kMostTimeS;
}

/// The one way from seconds to an instant: the nearest whole microsecond, halves away from zero.
/// Seconds that were written with at most six digits behind the point, within 2^32 (136 years) of
/// zero, are that very one: the double nearest to them and its product are off by less than a
/// half. Precondition: isTime(), as everything that is read is.
[[nodiscard]] inline std::int64_t inMicroseconds(double seconds) {
  return std::llround(seconds * kUsPerS);
}

/// Seconds for people. Read again, they are the same instant.
[[nodiscard]] inline double inSeconds(std::int64_t utimeUs) {
  return static_cast<double>(utimeUs) / kUsPerS;
}

}  // namespace foretouch::tools
