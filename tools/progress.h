// tools/progress.h: a progress bar on stderr for long work.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace foretouch::tools {

/// Draws only if stderr is a terminal, at most ten times a second; its destructor clears the line.
/// For one thread.
class ProgressBar {
 public:
  ProgressBar(std::string label, std::int64_t total);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void advanceTo(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::int64_t total_;
  bool visible_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_;
};

/// "replay [#####-----] 50 % 3/6, 0:02 left": the line for `done` of `total` after `elapsedS`.
[[nodiscard]] std::string progressLine(const std::string& label, std::int64_t done,
                                       std::int64_t total, double elapsedS);

}  // namespace foretouch::tools
