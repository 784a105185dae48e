// middleware/query/worker_threads.h: a fixed set of threads that all do one thing at a time: the
// one way in which lists of questions are shared out. Not installed.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "articulated/result.h"

namespace foretouch::internal {

/// The calling thread is one of them. Takes locks only to begin and to end a run.
class WorkerThreads {
 public:
  /// Errors: a number out of [1, most], or the system refuses the threads.
  static Result<WorkerThreads> start(int threads, int most);
  ~WorkerThreads();
  WorkerThreads(WorkerThreads&&) noexcept;
  WorkerThreads& operator=(WorkerThreads&&) noexcept;

  [[nodiscard]] std::size_t count() const;
  /// Calls `part` once on every thread, with numbers from 0, which is the calling one's; returns
  /// when the last one is done. `part` throws nothing. Not for two threads at once.
  void run(const std::function<void(std::size_t)>& part);

 private:
  struct Impl;
  explicit WorkerThreads(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::internal
