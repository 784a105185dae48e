#include "middleware/query/query_pool.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "lss/assert.h"
#include "middleware/query/link_query.h"

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

/// A list may follow the last one within microseconds, and waking a sleeping thread takes longer
/// than many lists.
template <typename Condition>
void waitBriefly(const Condition& isMet) {
  constexpr std::chrono::microseconds kBriefly{50};
  const auto end = std::chrono::steady_clock::now() + kBriefly;
  while (!isMet() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

/// Locks only to begin and to end a list, never for a task.
struct QueryPool::Impl {
  std::vector<Worker> workers;  // the calling thread's first
  std::vector<std::thread> threads;
  Work work;
  std::vector<FailedTask> failures;  // of the last list
  std::mutex mutex;
  std::condition_variable begins, ends;
  std::atomic<std::uint64_t> list{0};   // number of lists begun
  std::atomic<std::size_t> working{0};  // threads not done with the current list
  bool isStopping = false;

  ~Impl() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      isStopping = true;
    }
    begins.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  void run(std::size_t index) {
    std::uint64_t seen = 0;
    for (;;) {
      waitBriefly([&] { return list.load(std::memory_order_acquire) != seen; });
      std::unique_lock<std::mutex> lock(mutex);
      begins.wait(lock, [&] { return isStopping || list != seen; });
      if (isStopping) return;
      seen = list;
      lock.unlock();
      work.takePart(workers[index]);
      lock.lock();
      if (--working == 0) ends.notify_one();
    }
  }

  void answerAll() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      working = threads.size();
      ++list;
    }
    begins.notify_all();
    work.takePart(workers.front());
    waitBriefly([&] { return working.load(std::memory_order_acquire) == 0; });
    std::unique_lock<std::mutex> lock(mutex);
    ends.wait(lock, [&] { return working == 0; });
  }
};

QueryPool::QueryPool(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
QueryPool::~QueryPool() = default;
QueryPool::QueryPool(QueryPool&&) noexcept = default;
QueryPool& QueryPool::operator=(QueryPool&&) noexcept = default;

Result<QueryPool> QueryPool::start(int threads) {
  if (threads < 1 || threads > kMaxPoolThreads) {
    return Error::in("threads", ErrorCode::OutOfRange,
                     "expected a number from 1 to " + std::to_string(kMaxPoolThreads));
  }
  auto impl = std::make_unique<Impl>();
  impl->workers.resize(static_cast<std::size_t>(threads));
  impl->threads.reserve(static_cast<std::size_t>(threads - 1));
  try {
    for (std::size_t i = 1; i < impl->workers.size(); ++i) {
      impl->threads.emplace_back([pool = impl.get(), i] { pool->run(i); });
    }
  } catch (const std::system_error& failure) {
    return Error::in("threads", ErrorCode::DeviceFailed,
                     std::string("the system gives no more threads: ") + failure.what());
  }
  return QueryPool(std::move(impl));
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
  impl_->answerAll();
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
