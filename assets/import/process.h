// assets/import/process.h: runs one untrusted program to its end, under limits. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/cage.h"
#include "lss/sanitizer.h"

namespace foretouch::internal {

/// The sanitizers' runtimes reserve terabytes of address space, write files as they start, and turn
/// deaths by signal into exits: under them (kUnderSanitizer), there is no cage, and neither the
/// address space nor the size of files nor the number of processes is limited.
struct ProcessLimits {
  std::size_t addressSpaceBytes = 0;
  double seconds = 0.0;  ///< The most wall time, and (rounded up) CPU time.
  Cage cage = {};        ///< None by default.
};

/// How the process ended.
struct ProcessEnd {
  enum class Kind : std::uint8_t {
    NotStarted,  ///< `code` is the errno of the failed call.
    Exited,      ///< `code` is the exit status.
    Signalled,   ///< `code` is the signal that it died of by itself.
    TimedOut,    ///< Killed by us: wall time ran out; or it died of its CPU limit.
    Stopped,     ///< Killed by us: `take` returned false, or it closed its output and did not exit.
    Lost,        ///< Other code collected its status (a host that ignores SIGCHLD).
  };
  Kind kind = Kind::NotStarted;
  int code = 0;
  std::string errorOutput;  ///< The last bytes it wrote to stderr, unchanged.
};

/// Runs `program` with `arguments` and passes its standard output to `take` until that returns
/// false. Sets the limits between fork and exec, so they hold for any program from its first
/// instruction. When this returns, or throws an exception of `take`, the process and its
/// descendants are dead and collected, and every descriptor is closed. May be called from several
/// threads.
[[nodiscard]] ProcessEnd runLimited(const std::string& program,
                                    const std::vector<std::string>& arguments,
                                    const ProcessLimits& limits,
                                    const std::function<bool(std::string_view)>& take);

}  // namespace foretouch::internal
