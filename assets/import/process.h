// assets/import/process.h: one untrusted program run to its end, under limits. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace foretouch::internal {

/// The sanitizers' runtimes reserve terabytes of address space, write files as they start, and turn
/// deaths by signal into exits: under them, address space and file size go unlimited.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kUnderSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kUnderSanitizer = true;
#else
inline constexpr bool kUnderSanitizer = false;
#endif
#else
inline constexpr bool kUnderSanitizer = false;
#endif

struct ProcessLimits {
  std::size_t addressSpaceBytes = 0;
  double seconds = 0.0;  ///< Of wall time, and (rounded up) of CPU time.
};

/// How the process ended.
struct ProcessEnd {
  enum class Kind : std::uint8_t {
    NotStarted,  ///< `code` is the errno of what failed.
    Exited,      ///< `code` is the exit status.
    Signalled,   ///< `code` is the signal that it died of by itself.
    TimedOut,    ///< Killed by us: the wall time was over, or it died of its CPU limit.
    Stopped,     ///< Killed by us: `take` had enough, or it closed its output and lived on.
    Lost,        ///< Somebody else collected its status (a host that ignores SIGCHLD).
  };
  Kind kind = Kind::NotStarted;
  int code = 0;
  std::string errorOutput;  ///< The last bytes it wrote to stderr, as they came.
};

/// Runs `program` with `arguments`, handing its standard output to `take` until that returns false.
/// The limits are set between fork and exec, so they hold whatever the program is and before its
/// first instruction. When this returns, or throws what `take` threw, the process and those it
/// started are dead and collected, and every descriptor is closed. May be called from several
/// threads.
[[nodiscard]] ProcessEnd runLimited(const std::string& program,
                                    const std::vector<std::string>& arguments,
                                    const ProcessLimits& limits,
                                    const std::function<bool(std::string_view)>& take);

}  // namespace foretouch::internal
