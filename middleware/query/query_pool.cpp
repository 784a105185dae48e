#include "middleware/query/query_pool.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "middleware/query/link_query.h"
#include "middleware/query/worker_threads.h"

namespace foretouch {
namespace {

/// One thread's memory between queries.
struct alignas(128) Worker {
  QueryScratch scratch;
  ChainMotion motion;
  // Written throughout a query, and then swapped with the task's: adjacent answers share cache
  // lines.
  StepContacts answer;
  std::vector<FailedTask> failures;  // ascending, as a thread takes tasks
  bool isSuspect = false;            // a query was broken off: its memory may be half written

  void answerTo(const StepTask& task) {
    if (isSuspect) {
      scratch = QueryScratch();
      motion = ChainMotion();
    }
    isSuspect = true;
    motion.assign(task.query->avatar().skeleton(), *task.from, *task.to);
    task.query->answer(motion, scratch, answer);
    isSuspect = false;
  }
};

/// A list of tasks that the threads take from, one by one.
struct Work {
  const std::vector<StepTask>* tasks = nullptr;
  std::vector<StepContacts>* answers = nullptr;
  std::atomic<std::size_t> next{0};

  void takePart(Worker& worker) {
    worker.failures.clear();
    for (;;) {
      const std::size_t i = next.fetch_add(1, std::memory_order_relaxed);
      if (i >= tasks->size()) return;
      take(worker, i);
      std::swap(worker.answer, (*answers)[i]);
    }
  }

  /// Whatever happens, the worker's answer belongs to this task.
  void take(Worker& worker, std::size_t i) {
    const StepTask& task = (*tasks)[i];
    try {
      worker.answerTo(task);
    } catch (const std::exception& failure) {
      internal::leaveUnanswered(task.query->avatar().numLinks(), worker.answer.links);
      worker.answer.counters = {};
      worker.failures.push_back({i, Error::in("query", ErrorCode::DeviceFailed,
                                              std::string("broken off: ") + failure.what())});
    }
  }
};

}  // namespace

struct QueryPool::Impl {
  internal::WorkerThreads threads;
  std::vector<Worker> workers;  // one per thread
  Work work;
  std::vector<FailedTask> failures;  // of the last list

  explicit Impl(internal::WorkerThreads&& started)
      : threads(std::move(started)), workers(threads.count()) {}
};

QueryPool::QueryPool(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
QueryPool::~QueryPool() = default;
QueryPool::QueryPool(QueryPool&&) noexcept = default;
QueryPool& QueryPool::operator=(QueryPool&&) noexcept = default;

Result<QueryPool> QueryPool::start(int threads) {
  FORETOUCH_TRY(auto started, internal::WorkerThreads::start(threads, kMaxPoolThreads));
  return QueryPool(std::make_unique<Impl>(std::move(started)));
}

int QueryPool::threads() const {
  return static_cast<int>(impl_->workers.size());
}

Result<Done> QueryPool::answer(const std::vector<StepTask>& tasks,
                               std::vector<StepContacts>& answers) {
  for (const StepTask& task : tasks) {
    FORETOUCH_ASSERT(task.query != nullptr && task.from != nullptr && task.to != nullptr);
    static_cast<void>(task);
  }
  answers.resize(tasks.size());
  Work& work = impl_->work;
  work.tasks = &tasks;
  work.answers = &answers;
  work.next.store(0, std::memory_order_relaxed);
  impl_->threads.run([this](std::size_t worker) { impl_->work.takePart(impl_->workers[worker]); });
  std::vector<FailedTask>& failures = impl_->failures;
  failures.clear();
  for (const Worker& worker : impl_->workers) {
    failures.insert(failures.end(), worker.failures.begin(), worker.failures.end());
  }
  std::sort(failures.begin(), failures.end(),
            [](const FailedTask& x, const FailedTask& y) { return x.task < y.task; });
  if (!failures.empty()) return failures.front().error;
  return Done{};
}

const std::vector<FailedTask>& QueryPool::failures() const {
  return impl_->failures;
}

}  // namespace foretouch
