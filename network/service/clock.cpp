#include "network/service/clock.h"

#include <chrono>

namespace foretouch {
namespace {

class SystemClock final : public Clock {
 public:
  [[nodiscard]] std::int64_t utimeUs() const override {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  }
};

}  // namespace

const Clock& systemClock() {
  static const SystemClock clock;
  return clock;
}

}  // namespace foretouch
