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
  /// The `foretouch serve` beside this program, with `arguments`; returns once it says that it is
  /// ready. Errors: it ended before; the terminal has its stderr.
  static Result<ServiceProcess> start(const std::vector<std::string>& arguments);
  ServiceProcess(ServiceProcess&& other) noexcept;
  ServiceProcess& operator=(ServiceProcess&&) = delete;
  ~ServiceProcess();  ///< Kills the process if it still runs.

  /// Resident memory in bytes; -1 if it is gone.
  [[nodiscard]] std::int64_t residentBytes() const;
  /// What each open file descriptor is, as "socket", "anon_inode:[eventfd]", "/dev/null" and
  /// "*.lcmlog", sorted; none if the process is gone.
  [[nodiscard]] std::vector<std::string> openFiles() const;
  /// Sends SIGTERM; returns the exit code, -1 if a signal ended it.
  int stop();

 private:
  ServiceProcess(pid_t child, int output) : child_(child), output_(output) {}
  [[nodiscard]] std::string folder() const;  // in /proc
  pid_t child_ = -1;
  int output_ = -1;  // its stdout, kept open so that it never writes into a closed pipe
};

}  // namespace foretouch::tools
