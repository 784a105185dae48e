// middleware/query/query_pool.h: many avatars, many steps: a fixed set of threads that answers
// lists of them. A query takes no lock and, once the threads' memory has grown, allocates nothing;
// the answers are the same for any number of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "articulated/pose.h"
#include "articulated/result.h"
#include "middleware/query/query.h"

namespace foretouch {

/// One avatar's step. What it points to must outlive the call; poses are validated ones of the
/// query's avatar.
struct StepTask {
  const Query* query = nullptr;
  const Pose* from = nullptr;
  const Pose* to = nullptr;
};

/// A task that was broken off, by its place in the list, and why: memory ran out.
struct FailedTask {
  std::size_t task = 0;
  Error error;
};

inline constexpr int kMaxPoolThreads = 256;

class QueryPool {
 public:
  /// `threads` in [1, kMaxPoolThreads], the calling one among them. Errors: a number out of range,
  /// or the system refuses the threads.
  static Result<QueryPool> start(int threads);
  ~QueryPool();
  QueryPool(QueryPool&&) noexcept;
  QueryPool& operator=(QueryPool&&) noexcept;

  [[nodiscard]] int threads() const;

  /// Answers all tasks and returns when the last one is done; resizes and reuses `answers`. The
  /// error is that of the first task that failed; failures() lists them all. Every link of a failed
  /// task is Undecided, free until 0; the other tasks have their answers. Not for two threads at
  /// once.
  Result<Done> answer(const std::vector<StepTask>& tasks, std::vector<StepContacts>& answers);
  /// Of the last list, in its order.
  [[nodiscard]] const std::vector<FailedTask>& failures() const;

 private:
  struct Impl;
  explicit QueryPool(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
