// tools/stream/stop_signal.h: lets a program that runs until a signal end in order.
#pragma once

#include <array>
#include <chrono>
#include <csignal>

namespace foretouch::tools {

/// While one lives, the first SIGINT, SIGTERM or SIGHUP ends wait() instead of the program, in
/// whatever thread it arrives. Once wait() has returned true, a second one ends the program at
/// once, so that an orderly stop cannot hang it. At most one at a time. Signals that the parent set
/// to ignored (nohup) stay ignored.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  /// Whether a signal has come; waits up to `most` for one.
  [[nodiscard]] bool wait(std::chrono::milliseconds most);

 private:
  void restore();
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
  std::array<int, 2> pipe_{-1, -1};
  bool isRestored_ = false;
};

}  // namespace foretouch::tools
