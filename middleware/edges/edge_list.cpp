// The edges of a list: EdgeQuery::answerAll() and answerPath().

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/try.h"
#include "middleware/edges/edge_query.h"
#include "middleware/query/first_failure.h"

namespace foretouch {
namespace {

/// Edges are taken in groups: adjacent answers share cache lines, and so does the counter.
constexpr std::size_t kEdgesAtOnce = 8;

/// What one thread keeps between lists.
struct alignas(128) EdgeListMemory : internal::ScratchPart {
  static constexpr internal::ScratchKind kKind = internal::ScratchKind::EdgeList;

  internal::FirstFailure failure{"edges"};
  std::vector<EdgeAnswer> ofPath;
};

/// A list of edges that the threads take from, group by group, in order.
struct EdgeList {
  const EdgeQuery& edges;
  const double* q0;
  const double* q1;
  std::size_t count;
  bool isPath;  // no edge behind one that is not clear is needed
  std::vector<EdgeAnswer>& answers;
  std::atomic<std::size_t> next{0}, firstMet{count};

  void takePart(Scratch& scratch) {
    for (;;) {
      const std::size_t begin = next.fetch_add(kEdgesAtOnce, std::memory_order_relaxed);
      const std::size_t end = std::min(begin + kEdgesAtOnce, count);
      for (std::size_t i = begin; i < end; ++i) {
        if (isPath && i > firstMet.load(std::memory_order_relaxed)) return;
        take(i, scratch);
      }
      if (end >= count) return;
    }
  }

  void take(std::size_t i, Scratch& scratch) {
    EdgeAnswer& answer = answers[i];
    const auto ask = [&]() -> Result<Done> {
      const std::size_t n = edges.robot().numCoordinates();
      FORETOUCH_TRY(answer, edges.answer(q0 + i * n, q1 + i * n, n, scratch));
      return Done{};
    };
    const auto renew = [&] {
      scratch.forget(internal::ScratchKind::Edge);
      scratch.forget(internal::ScratchKind::Query);
    };
    answer = {};
    scratch.of<EdgeListMemory>().failure.attempt(i, ask, renew);
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

/// On all threads; the path's first edge that is not clear, if asked for.
Result<std::size_t> run(WorkerPool& pool, EdgeList&& list) {
  const auto numThreads = static_cast<std::size_t>(pool.threads());
  for (std::size_t i = 0; i < numThreads; ++i) {
    pool.scratch(i).of<EdgeListMemory>().failure.clear();
  }
  list.answers.resize(list.count);
  pool.run([&](std::size_t thread) { list.takePart(pool.scratch(thread)); });
  FORETOUCH_CHECK(internal::FirstFailure::of(
      numThreads, [&](std::size_t i) -> const auto& {
        return pool.scratch(i).of<EdgeListMemory>().failure;
      }));
  return list.firstMet.load(std::memory_order_relaxed);
}

}  // namespace

Result<Done> EdgeQuery::answerAll(const double* q0, const double* q1, std::size_t count,
                                  WorkerPool& pool, std::vector<EdgeAnswer>& answers) const {
  FORETOUCH_CHECK(checkAll(robot(), q0, count));
  FORETOUCH_CHECK(checkAll(robot(), q1, count));
  FORETOUCH_CHECK(run(pool, {*this, q0, q1, count, false, answers}));
  return Done{};
}

Result<PathAnswer> EdgeQuery::answerPath(const double* q, std::size_t count,
                                         WorkerPool& pool) const {
  if (count < 2) {
    return Error::in("path", ErrorCode::Empty,
                     "expected at least two configurations, found " + std::to_string(count));
  }
  FORETOUCH_CHECK(checkAll(robot(), q, count));
  std::vector<EdgeAnswer>& answers = pool.scratch().of<EdgeListMemory>().ofPath;
  const double* next = q + robot().numCoordinates();
  PathAnswer path;
  FORETOUCH_TRY(path.edge, run(pool, {*this, q, next, count - 1, true, answers}));
  const bool isFree = path.edge == count - 1;
  path.answer = answers[isFree ? count - 2 : path.edge];
  // Rounded down, but at the edge's own begin.
  const double until = isFree ? 0.0 : path.answer.freeUntil;
  path.freeUntil = static_cast<double>(path.edge) + until;
  if (until > 0.0) path.freeUntil = std::nextafter(path.freeUntil, static_cast<double>(path.edge));
  return path;
}

}  // namespace foretouch
