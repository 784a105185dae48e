// tests/network/world_stream/crowd_spans.h: sets of spans of a timeline, in microseconds after
// kCrowdBaseUs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "middleware/world/world_contacts.h"
#include "tests/network/world_stream/crowd.h"

namespace foretouch::test {

inline constexpr std::int64_t kCrowdBaseUs = kCrowdBeginUs - 1'000'000;
inline constexpr double kEver = 1e9;

[[nodiscard]] inline double after(std::int64_t us) {
  return static_cast<double>(us - kCrowdBaseUs);
}
[[nodiscard]] inline double after(const WorldTime& time) {
  return microsecondsAfter(kCrowdBaseUs, time);
}

/// The other way, rounded down.
[[nodiscard]] inline std::int64_t microsecond(double us) {
  return kCrowdBaseUs + static_cast<std::int64_t>(std::floor(us));
}

struct TimeSpan {
  double from = 0.0, to = 0.0;
};
using TimeSpans = std::vector<TimeSpan>;

inline void add(TimeSpans& to, const TimeSpans& more) {
  to.insert(to.end(), more.begin(), more.end());
}
[[nodiscard]] inline bool isIn(const TimeSpans& spans, double us, double slack) {
  return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& span) {
    return us >= span.from - slack && us <= span.to + slack;
  });
}
/// What of `spans` lies in `within`.
[[nodiscard]] inline TimeSpans clipped(const TimeSpans& spans, const TimeSpan& within) {
  TimeSpans inside;
  for (const TimeSpan& span : spans) {
    const TimeSpan part{std::max(span.from, within.from), std::min(span.to, within.to)};
    if (part.from <= part.to) inside.push_back(part);
  }
  return inside;
}
/// What of `whole` is in none of them.
[[nodiscard]] inline TimeSpans rest(TimeSpans spans, const TimeSpan& whole) {
  std::sort(spans.begin(), spans.end(),
            [](const TimeSpan& x, const TimeSpan& y) { return x.from < y.from; });
  TimeSpans gaps;
  double from = whole.from;
  for (const TimeSpan& span : spans) {
    if (span.from > from) gaps.push_back({from, std::min(span.from, whole.to)});
    from = std::max(from, span.to);
    if (from >= whole.to) break;
  }
  if (from < whole.to) gaps.push_back({from, whole.to});
  return gaps;
}
[[nodiscard]] inline double lengthOf(const TimeSpans& spans) {
  double sum = 0.0;
  for (const TimeSpan& span : spans) sum += span.to - span.from;
  return sum;
}

}  // namespace foretouch::test
