// middleware/query/first_failure.h: tasks that several threads share: of those that fail, the one
// with the least number says why, whichever thread took it. Not installed.
#pragma once

#include <cstddef>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "articulated/result.h"

namespace foretouch::internal {

/// Memory ran out in a question about `what`.
[[nodiscard]] inline Error brokenOff(const char* what, const std::exception& broken) {
  return Error::in(what, ErrorCode::DeviceFailed, std::string("broken off: ") + broken.what());
}

/// The first failure of the tasks that one thread took.
class FirstFailure {
 public:
  /// `what` the tasks are about: a literal.
  explicit FirstFailure(const char* what) : what_(what) {}
  void clear() { error_.reset(); }

  /// Does the task, which returns a Result<Done>. `renew`: what it may have left half written.
  template <typename Task, typename Renew>
  void attempt(std::size_t number, const Task& task, const Renew& renew) {
    std::optional<Error> error;
    try {
      const Result<Done> done = task();
      if (!done.ok()) error = done.error();
    } catch (const std::exception& broken) {
      renew();
      error = brokenOff(what_, broken);
    }
    if (!error || (error_ && number_ < number)) return;
    error_ = std::move(error);
    number_ = number;
  }

  /// The first one of all threads: `failureOf(i)` is that of thread i.
  template <typename FailureOf>
  [[nodiscard]] static Result<Done> of(std::size_t numThreads, const FailureOf& failureOf) {
    const FirstFailure* first = nullptr;
    for (std::size_t i = 0; i < numThreads; ++i) {
      const FirstFailure& failure = failureOf(i);
      if (!failure.error_) continue;
      if (first == nullptr || failure.number_ < first->number_) first = &failure;
    }
    if (first != nullptr) return *first->error_;
    return Done{};
  }

 private:
  const char* what_;
  std::optional<Error> error_;
  std::size_t number_ = 0;
};

}  // namespace foretouch::internal
