// tools/stream/stop_signal.h: lets a program that runs until a signal end in order.
#pragma once

#include <chrono>
#include <optional>

#include "assets/system_files.h"
#include "tools/interrupt.h"

namespace foretouch::tools {

/// While one lives, the first SIGINT, SIGTERM or SIGHUP ends wait() instead of the program, in
/// whatever thread it arrives. Once wait() has returned true, a second one ends the program at
/// once, so that an orderly stop cannot hang it. At most one at a time.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Whether a signal has come; waits up to `most` for one.
  [[nodiscard]] bool wait(std::chrono::milliseconds most);

 private:
  /// Closed when the signals are no longer handled.
  struct Pipe {
    Pipe();
    ~Pipe();
    internal::FileDescriptor readEnd, writeEnd;
  };
  Pipe pipe_;
  std::optional<HandledSignals> signals_;  // nothing without a pipe: they end the program as usual
};

}  // namespace foretouch::tools
