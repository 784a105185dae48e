// bench/ask/asked_times.h: the times of single questions.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace foretouch::tools {

/// Microseconds by a steady clock, less the time to read it.
class AskedTimes {
 public:
  AskedTimes() {
    for (int i = 0; i < kReadings; ++i) overheadUs_ = std::min(overheadUs_, usOf([] {}));
  }
  template <typename Work>
  void time(const Work& work) {
    us.push_back(std::max(0.0, usOf(work) - overheadUs_));
  }

  std::vector<double> us;

 private:
  static constexpr int kReadings = 1000;

  template <typename Work>
  static double usOf(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin)
        .count();
  }
  double overheadUs_ = 1.0;
};

}  // namespace foretouch::tools
