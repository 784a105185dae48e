// tools/interrupt.h: lets an interrupted run clean up first.
#pragma once

#include <array>
#include <csignal>

namespace foretouch::tools {

/// SIGINT, SIGTERM and SIGHUP call a handler until the end of a block, or until restore(). Those
/// that the parent set to ignored (nohup) stay ignored.
class HandledSignals {
 public:
  explicit HandledSignals(void (*handler)(int));
  HandledSignals(const HandledSignals&) = delete;
  HandledSignals& operator=(const HandledSignals&) = delete;
  ~HandledSignals() { restore(); }

  /// Restores the signals as they were before.
  void restore();

 private:
  static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_{};
  bool isRestored_ = false;
};

/// While one lives, these signals are only noted. Its destructor restores the handlers and delivers
/// a noted signal: the program then ends by it, as the shell expects, after every object built
/// after the guard is destroyed. At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  [[nodiscard]] bool requested() const;

 private:
  HandledSignals signals_;
};

}  // namespace foretouch::tools
