// bench/service_process.h: `foretouch serve` as a process of its own, started, watched and
// stopped: for measurements and trials of the stream.
#pragma once

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <vector>

#include "articulated/result.h"

namespace foretouch::tools {

class ServiceProcess {
 public:
  /// This program as `serve` with `arguments`; returns once it says that it is ready. Errors: it
  /// ended before, with what it said on stderr left to the terminal.
  static Result<ServiceProcess> start(const std::vector<std::string>& arguments);
  ServiceProcess(ServiceProcess&& other) noexcept;
  ServiceProcess& operator=(ServiceProcess&&) = delete;
  ~ServiceProcess();  ///< Kills what is still there.

  /// Resident memory in bytes, and open file descriptors; -1 where it is gone.
  [[nodiscard]] std::int64_t residentBytes() const;
  [[nodiscard]] std::int64_t openFiles() const;
  /// SIGTERM; the exit code, -1 where a signal ended it.
  int stop();

 private:
  ServiceProcess(pid_t child, int output) : child_(child), output_(output) {}
  pid_t child_ = -1;
  int output_ = -1;  // its stdout, kept open so that it never writes into a closed pipe
};

}  // namespace foretouch::tools
