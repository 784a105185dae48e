// network/service/thread_beat.h: when a thread last made progress, so that others can tell that it
// is stuck.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace foretouch {

class ThreadBeat {
 public:
  ThreadBeat() : lastMs_(nowMs()) {}
  void beat() { lastMs_.store(nowMs(), std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t idleMs() const {
    return nowMs() - lastMs_.load(std::memory_order_relaxed);
  }

 private:
  static std::int64_t nowMs() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
  }
  std::atomic<std::int64_t> lastMs_;
};

}  // namespace foretouch
