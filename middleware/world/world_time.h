// middleware/world/world_time.h: instants of world time, finer than the microseconds of poses.
#pragma once

#include <cstdint>
#include <tuple>

namespace foretouch {

/// `us` whole microseconds and a fraction in [0,1) of one more.
struct WorldTime {
  std::int64_t us = 0;
  double fraction = 0.0;
};
[[nodiscard]] inline bool operator<(const WorldTime& x, const WorldTime& y) {
  return std::tie(x.us, x.fraction) < std::tie(y.us, y.fraction);
}
[[nodiscard]] inline bool operator==(const WorldTime& x, const WorldTime& y) {
  return x.us == y.us && x.fraction == y.fraction;
}

/// The instant at `t` in [0,1] of the span [beginUs, endUs], rounded down: never later than it is.
[[nodiscard]] WorldTime worldTimeAt(std::int64_t beginUs, std::int64_t endUs, double t);
/// The next instant that can be told.
[[nodiscard]] WorldTime justAfter(const WorldTime& time);
/// From `us` to the instant, in microseconds, rounded.
[[nodiscard]] inline double microsecondsAfter(std::int64_t us, const WorldTime& time) {
  return static_cast<double>(time.us - us) + time.fraction;
}

}  // namespace foretouch
