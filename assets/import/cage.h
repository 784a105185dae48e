// assets/import/cage.h: what a process that reads a stranger's file may still do: read the named
// folders, allocate, and write to what its parent opened. Landlock bounds files, seccomp bounds
// system calls; both are the kernel's, and hold for whatever code the file makes the process run.
// Source: the kernel's documentation, "Landlock: unprivileged access control" and "Seccomp BPF".
// Not installed.
#pragma once

#include <linux/filter.h>
#include <string>
#include <vector>

namespace foretouch::internal {

/// What this kernel offers.
struct CageParts {
  int landlock = 0;  ///< The version of its interface; 0 if there is none (before Linux 5.13).
  bool seccomp = false;
};
[[nodiscard]] CageParts partsOfThisKernel();

/// In one sentence, what an importer could still do for want of the missing parts; empty if none is
/// missing.
[[nodiscard]] std::string weaknessOf(const CageParts& parts);

/// Made before fork(), where memory may be allocated; entered after it.
class Cage {
 public:
  /// No cage: enter() does nothing.
  Cage() = default;
  /// The cage of a process that runs `program` and may read what lies in `readable` (folders, with
  /// all that is below them, and files). The process may load libraries from where the system and
  /// `libraryPath` (LD_LIBRARY_PATH) have them.
  Cage(const std::string& program, const std::vector<std::string>& readable,
       const std::string& libraryPath);

  /// Closes the calling process's files, except what it has open. Async-signal-safe. False with
  /// errno set; true where the kernel has no Landlock.
  [[nodiscard]] bool closeFiles() const;
  /// Closes the calling process's system calls, but for those of a reader and execve(). Needs
  /// no_new_privs. Async-signal-safe. False with errno set; true where the kernel has no seccomp.
  [[nodiscard]] bool closeCalls();

 private:
  struct Door {
    std::string path;
    bool runs;  ///< Programs may be run from it.
  };
  std::vector<Door> doors_;
  std::vector<sock_filter> filter_;
  std::vector<std::size_t> ownIds_;  ///< Where the filter compares with the process's own id.
  CageParts parts_;
};

/// For the importer itself, once its libraries are loaded: from now on it runs no other program and
/// gets no new code. Does nothing in a process without a cage: one that a developer runs by hand.
void closeCageBehindUs();

}  // namespace foretouch::internal
