// tools/interrupt.h: lets an interrupted run clean up first.
#pragma once

#include <array>
#include <csignal>

namespace foretouch::tools {

/// While one lives, SIGINT, SIGTERM and SIGHUP are only noted. Its destructor restores the handlers
/// and delivers a noted signal: the program then ends by it, as the shell expects, after every
/// object built after the guard is destroyed. At most one at a time. Signals that the parent set to
/// ignored (nohup) stay ignored.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  [[nodiscard]] bool requested() const;

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace foretouch::tools
