#include "middleware/edges/edge_pool.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "middleware/query/first_failure.h"
#include "middleware/query/worker_threads.h"

namespace foretouch {
namespace {

/// Edges are taken in groups: adjacent answers share cache lines, and so does the counter.
constexpr std::size_t kEdgesAtOnce = 8;

/// One thread's memory between edges.
struct alignas(128) EdgeWorker {
  EdgeScratch scratch;
  internal::FirstFailure failure{"edges"};
};

/// A list of edges that the threads take from, group by group, in order.
struct EdgeWork {
  const EdgeQuery* edges = nullptr;
  const double* q0 = nullptr;
  const double* q1 = nullptr;
  std::size_t count = 0;
  std::vector<EdgeAnswer>* answers = nullptr;
  bool isPath = false;  // no edge behind one that is not clear is needed
  std::atomic<std::size_t> next{0}, firstMet{0};

  void takePart(EdgeWorker& worker) {
    worker.failure.clear();
    for (;;) {
      const std::size_t begin = next.fetch_add(kEdgesAtOnce, std::memory_order_relaxed);
      const std::size_t end = std::min(begin + kEdgesAtOnce, count);
      for (std::size_t i = begin; i < end; ++i) {
        if (isPath && i > firstMet.load(std::memory_order_relaxed)) return;
        take(worker, i);
      }
      if (end >= count) return;
    }
  }

  void take(EdgeWorker& worker, std::size_t i) {
    EdgeAnswer& answer = (*answers)[i];
    const auto ask = [&]() -> Result<Done> {
      const std::size_t n = edges->robot().numCoordinates();
      FORETOUCH_TRY(answer, edges->answer(q0 + i * n, q1 + i * n, n, worker.scratch));
      return Done{};
    };
    answer = {};
    worker.failure.attempt(i, ask, [&] { worker.scratch = {}; });
    if (!isPath || answer.verdict == Verdict::Clear) return;
    std::size_t first = firstMet.load(std::memory_order_relaxed);
    while (i < first && !firstMet.compare_exchange_weak(first, i)) {
    }
  }
};

/// All configurations, before any edge is asked.
Result<Done> checkAll(const Robot& robot, const double* q, std::size_t count) {
  const std::size_t n = robot.numCoordinates();
  for (std::size_t i = 0; i < count; ++i) {
    auto checked = robot.checked(q + i * n, n);
    if (checked.ok()) continue;
    Error error = checked.error();
    error.message = "configuration " + std::to_string(i) + ": " + error.message;
    error.index = static_cast<std::int64_t>(i);
    return error;
  }
  return Done{};
}

}  // namespace

struct EdgePool::Impl {
  internal::WorkerThreads threads;
  std::vector<std::unique_ptr<EdgeWorker>> workers;  // one per thread
  EdgeWork work;
  std::vector<EdgeAnswer> ofPath;

  explicit Impl(internal::WorkerThreads&& started) : threads(std::move(started)) {
    for (std::size_t i = 0; i < threads.count(); ++i) {
      workers.push_back(std::make_unique<EdgeWorker>());
    }
  }

  Result<Done> run(const EdgeQuery& edges, const double* q0, const double* q1, std::size_t count,
                   bool isPath, std::vector<EdgeAnswer>& answers) {
    answers.resize(count);
    work.edges = &edges;
    work.q0 = q0;
    work.q1 = q1;
    work.count = count;
    work.answers = &answers;
    work.isPath = isPath;
    work.next.store(0, std::memory_order_relaxed);
    work.firstMet.store(count, std::memory_order_relaxed);
    threads.run([this](std::size_t worker) { work.takePart(*workers[worker]); });
    return internal::FirstFailure::of(workers);
  }
};

EdgePool::EdgePool(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EdgePool::~EdgePool() = default;
EdgePool::EdgePool(EdgePool&&) noexcept = default;
EdgePool& EdgePool::operator=(EdgePool&&) noexcept = default;

Result<EdgePool> EdgePool::start(int threads) {
  FORETOUCH_TRY(auto started, internal::WorkerThreads::start(threads, kMaxPoolThreads));
  return EdgePool(std::make_unique<Impl>(std::move(started)));
}

int EdgePool::threads() const {
  return static_cast<int>(impl_->threads.count());
}

Result<Done> EdgePool::answer(const EdgeQuery& edges, const double* q0, const double* q1,
                              std::size_t count, std::vector<EdgeAnswer>& answers) {
  FORETOUCH_CHECK(checkAll(edges.robot(), q0, count));
  FORETOUCH_CHECK(checkAll(edges.robot(), q1, count));
  return impl_->run(edges, q0, q1, count, false, answers);
}

Result<PathAnswer> EdgePool::answerPath(const EdgeQuery& edges, const double* q,
                                        std::size_t count) {
  if (count < 2) {
    return Error::in("path", ErrorCode::Empty,
                     "expected at least two configurations, found " + std::to_string(count));
  }
  FORETOUCH_CHECK(checkAll(edges.robot(), q, count));
  std::vector<EdgeAnswer>& answers = impl_->ofPath;
  const double* next = q + edges.robot().numCoordinates();
  FORETOUCH_CHECK(impl_->run(edges, q, next, count - 1, true, answers));
  PathAnswer path;
  path.edge = impl_->work.firstMet.load(std::memory_order_relaxed);
  const bool isFree = path.edge == count - 1;
  path.answer = answers[isFree ? count - 2 : path.edge];
  // Rounded down, but at the edge's own begin.
  const double until = isFree ? 0.0 : path.answer.freeUntil;
  path.freeUntil = static_cast<double>(path.edge) + until;
  if (until > 0.0) path.freeUntil = std::nextafter(path.freeUntil, static_cast<double>(path.edge));
  return path;
}

}  // namespace foretouch
