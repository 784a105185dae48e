// tests/tools/program_run.h: runs the built program as a user would, and captures its output.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/temp_folder.h"

namespace foretouch::test {

struct Ended {
  int exitCode = -1;  ///< -1 if a signal ended it.
  int signal = 0;
  std::string out, err;
};

/// The program, started; ended() waits for it.
class ProgramRun {
 public:
  /// Adds `environment` entries ("NAME=value") to the test's. `out`: the destination of stdout;
  /// empty: captures it. `program`: another program, found like in a shell.
  explicit ProgramRun(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment = {}, const std::string& out = "",
                      const std::string& program = "");
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;
  ~ProgramRun();

  [[nodiscard]] pid_t id() const { return child_; }
  void send(int signal) const;
  /// Its stdout so far.
  [[nodiscard]] std::string outSoFar() const { return contentOf(out_); }
  /// Its stderr so far.
  [[nodiscard]] std::string errSoFar() const { return contentOf(folder_ / "err"); }
  Ended ended();

 private:
  TempFolder folder_;
  std::string out_;
  pid_t child_ = -1;
};

Ended runForetouch(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});
/// `foretouch-bench`, beside it.
Ended runBench(const std::vector<std::string>& arguments);
/// `foretouch-verify`, beside it.
Ended runVerify(const std::vector<std::string>& arguments);

}  // namespace foretouch::test
