// tools/batch/child.h: runs one replay as its own process, so that its end ends nothing else.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace foretouch::tools {

struct ChildPlan {
  std::string program;
  std::vector<std::string> words;  ///< The words behind the program's name.
  std::string folder;              ///< The folder in which it runs.
  double seconds = 0.0;            ///< It is killed after so long; 0: never.
};

struct ChildEnd {
  bool isStopped = false;  ///< Killed because `stop` said so.
  bool isLate = false;     ///< Killed because its time was over.
  int signal = 0;          ///< The signal that ended it otherwise; 0: none.
  int code = -1;           ///< Its exit code; -1: none.
  std::string failure;     ///< Why it could not be started; empty: it was.
  std::string out, err;    ///< The ends of what it wrote, at most 16 MiB and 4 KiB.

  [[nodiscard]] bool isDone() const { return failure.empty() && signal == 0 && code == 0; }
};

/// Runs it to its end; asks `stop` ten times a second. It is killed if this process dies, or the
/// thread that called. May be called from several threads.
[[nodiscard]] ChildEnd runChild(const ChildPlan& plan, const std::function<bool()>& stop);

/// Why the process failed, in one line: what it said itself if it said something.
[[nodiscard]] std::string whyFailed(const ChildEnd& end, double seconds);

}  // namespace foretouch::tools
