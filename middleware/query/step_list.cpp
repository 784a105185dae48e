// The steps of a list: Query::answerAll().
#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#include "lss/assert.h"
#include "middleware/pair/link_query.h"
#include "middleware/query/first_failure.h"
#include "middleware/query/query.h"

namespace foretouch {
namespace {

/// What one thread keeps between lists.
struct alignas(128) StepListMemory : internal::ScratchPart {
  static constexpr internal::ScratchKind kKind = internal::ScratchKind::StepList;

  ChainMotion motion;
  // Written throughout a query, and then swapped with the task's: adjacent answers share cache
  // lines.
  StepContacts answer;
  std::vector<FailedTask> failures;  // ascending, as a thread takes tasks
};

/// A list of tasks that the threads take from, one by one.
struct StepList {
  const std::vector<StepTask>& tasks;
  std::vector<StepContacts>& answers;
  std::atomic<std::size_t> next{0};

  void takePart(Scratch& scratch) {
    auto& memory = scratch.of<StepListMemory>();
    for (;;) {
      const std::size_t i = next.fetch_add(1, std::memory_order_relaxed);
      if (i >= tasks.size()) return;
      take(memory, i, scratch);
      std::swap(memory.answer, answers[i]);
    }
  }

  /// Whatever happens, the thread's answer belongs to this task.
  void take(StepListMemory& memory, std::size_t i, Scratch& scratch) {
    const StepTask& task = tasks[i];
    try {
      memory.motion.assign(task.query->avatar().skeleton(), *task.from, *task.to);
      task.query->answer(memory.motion, scratch, memory.answer);
    } catch (const std::exception& broken) {
      scratch.forget(internal::ScratchKind::Query);
      memory.motion = {};
      internal::leaveUnanswered(task.query->avatar().numLinks(), memory.answer.links);
      memory.answer.counters = {};
      memory.failures.push_back({i, internal::brokenOff("query", broken)});
    }
  }
};

}  // namespace

Result<Done> Query::answerAll(const std::vector<StepTask>& tasks, WorkerPool& pool,
                              std::vector<StepContacts>& answers,
                              std::vector<FailedTask>* failures) {
  for (const StepTask& task : tasks) {
    FORETOUCH_ASSERT(task.query != nullptr && task.from != nullptr && task.to != nullptr);
    static_cast<void>(task);
  }
  answers.resize(tasks.size());
  const auto numThreads = static_cast<std::size_t>(pool.threads());
  for (std::size_t i = 0; i < numThreads; ++i) {
    pool.scratch(i).of<StepListMemory>().failures.clear();
  }
  StepList list{tasks, answers};
  pool.run([&](std::size_t thread) { list.takePart(pool.scratch(thread)); });
  std::vector<FailedTask> all;
  for (std::size_t i = 0; i < numThreads; ++i) {
    const auto& own = pool.scratch(i).of<StepListMemory>().failures;
    all.insert(all.end(), own.begin(), own.end());
  }
  std::sort(all.begin(), all.end(),
            [](const FailedTask& x, const FailedTask& y) { return x.task < y.task; });
  const Result<Done> done = all.empty() ? Result<Done>(Done{}) : Result<Done>(all.front().error);
  if (failures != nullptr) *failures = std::move(all);
  return done;
}

}  // namespace foretouch
