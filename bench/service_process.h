// bench/service_process.h: starts, watches and stops `foretouch serve` as a separate process: for
// measurements and trials of the stream.
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
  /// ended before; the terminal has its stderr.
  static Result<ServiceProcess> start(const std::vector<std::string>& arguments);
  ServiceProcess(ServiceProcess&& other) noexcept;
  ServiceProcess& operator=(ServiceProcess&&) = delete;
  ~ServiceProcess();  ///< Kills the process if it still runs.

  /// Resident memory in bytes, and open file descriptors; -1 if it is gone.
  [[nodiscard]] std::int64_t residentBytes() const;
  [[nodiscard]] std::int64_t openFiles() const;
  /// SIGTERM; the exit code, -1 if a signal ended it.
  int stop();

 private:
  ServiceProcess(pid_t child, int output) : child_(child), output_(output) {}
  pid_t child_ = -1;
  int output_ = -1;  // its stdout, kept open so that it never writes into a closed pipe
};

}  // namespace foretouch::tools
