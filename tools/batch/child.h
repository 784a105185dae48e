// tools/batch/child.h: one replay as a process of its own, so that its end is nobody else's.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace foretouch::tools {

struct ChildPlan {
  std::string program;
  std::vector<std::string> words;  ///< Behind the program's name.
  std::string folder;              ///< In which it runs.
  double seconds = 0.0;            ///< Killed when they are over; 0: never.
};

struct ChildEnd {
  bool isStopped = false;  ///< Killed because `stop` said so.
  bool isLate = false;     ///< Killed because its time was over.
  int signal = 0;          ///< That ended it, otherwise; 0: none.
  int code = -1;           ///< Its exit code; -1: none.
  std::string failure;     ///< Why it could not be started; empty: it was.
  std::string out, err;    ///< The ends of what it wrote, at most 16 MiB and 4 KiB.

  [[nodiscard]] bool isDone() const { return failure.empty() && signal == 0 && code == 0; }
};

/// Runs it to its end; asks `stop` ten times a second. It is killed if this process dies, or the
/// thread that called. May be called from several threads.
[[nodiscard]] ChildEnd runChild(const ChildPlan& plan, const std::function<bool()>& stop);

/// Why it is not done, in one line: what it said itself if it said something.
[[nodiscard]] std::string whyFailed(const ChildEnd& end, double seconds);

}  // namespace foretouch::tools
