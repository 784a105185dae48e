// middleware/worker_pool.h: a fixed set of threads, each with scratch memory of its own, that share
// out lists of questions: steps (Query::answerAll()), edges (EdgeQuery::answerAll()), a world's
// window (World::contacts()). The answers are the same, to the bit, for any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "articulated/result.h"
#include "middleware/scratch.h"

namespace foretouch {

inline constexpr int kMaxPoolThreads = 256;

/// Takes locks only to begin and to end a list. One list at a time: not for two threads at once.
class WorkerPool {
 public:
  /// `threads` in [1, kMaxPoolThreads], the calling one among them. Errors: a number out of range,
  /// or the system refuses the threads.
  static Result<WorkerPool> start(int threads);
  ~WorkerPool();
  WorkerPool(WorkerPool&&) noexcept;
  WorkerPool& operator=(WorkerPool&&) noexcept;

  [[nodiscard]] int threads() const;

  /// For the questions' own sources: calls `part` once on every thread, with numbers from 0, which
  /// is the calling one's; returns when the last one is done. `part` throws nothing.
  void run(const std::function<void(std::size_t)>& part);
  /// The memory of the thread with this number.
  [[nodiscard]] Scratch& scratch(std::size_t thread = 0);

 private:
  struct Impl;
  explicit WorkerPool(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
