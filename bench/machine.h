// bench/machine.h: the machine of a measurement.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/report.h"

namespace foretouch::tools {

/// An empty report of this process: its command line, the time and the machine as it is now.
[[nodiscard]] BenchReport startedReport(std::string kind, std::string title);

/// The words of a command line, quoted for a shell, the program as "foretouch-bench" and files by
/// their names, without their folders, which do not concern readers.
[[nodiscard]] std::string commandLine(const std::vector<std::string>& arguments);

/// Keeps the calling thread on one processor; false if the system refuses.
[[nodiscard]] bool pinToProcessor(int processor);

/// What the program has allocated and not freed (glibc's count; else 0).
[[nodiscard]] double heapMiB();

/// The time to read a clock: between two readings with nothing in between, the least of many.
template <typename NowUs>
[[nodiscard]] double overheadOf(const NowUs& nowUs) {
  constexpr int kReadings = 10'000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kReadings; ++i) {
    const double from = nowUs();
    least = std::min(least, nowUs() - from);
  }
  return least;
}

/// Processor time of this thread since it was made, less the time to read that clock: a system
/// call, which takes more than a microsecond on some machines. Other work on the machine does not
/// count.
class ThreadStopwatch {
 public:
  ThreadStopwatch();
  [[nodiscard]] double us() const;

 private:
  double overheadUs_, beginUs_;  ///< In this order: the first is found before the second.
};

}  // namespace foretouch::tools
