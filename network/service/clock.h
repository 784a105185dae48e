// network/service/clock.h: the time of day behind a seam. It stamps messages and orders nothing: no
// verdict depends on it. Not installed.
#pragma once

#include <cstdint>

namespace foretouch {

class Clock {
 public:
  virtual ~Clock() = default;
  /// Microseconds since the Unix epoch. Safe from several threads.
  [[nodiscard]] virtual std::int64_t utimeUs() const = 0;
};

[[nodiscard]] const Clock& systemClock();

}  // namespace foretouch
