// tests/tools/program_run.h: runs the built program as a user would, and catches what it says.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

#include "tests/support/temp_folder.h"

namespace foretouch::test {

struct Ended {
  int exitCode = -1;  ///< -1 where a signal ended it.
  int signal = 0;
  std::string out, err;
};

/// The program, started; ended() waits for it.
class ProgramRun {
 public:
  /// `environment` entries ("NAME=value") are added to what the test has. `out` is where stdout
  /// goes; empty: it is caught.
  explicit ProgramRun(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& environment = {},
                      const std::string& out = "");
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;
  ~ProgramRun();

  void send(int signal) const;
  Ended ended();

 private:
  TempFolder folder_;
  std::string out_;
  pid_t child_ = -1;
};

Ended runForetouch(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});

}  // namespace foretouch::test
