// The edges of a list: EdgeQuery::answerAll() and answerPath().

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "articulated/try.h"
#include "middleware/edges/edge_query.h"
#include "middleware/edges/edge_tasks.h"

namespace foretouch {

using internal::checkAll;

Result<Done> internal::checkAll(const Robot& robot, const double* q, std::size_t count) {
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

Result<Done> EdgeQuery::answerAll(const double* q0, const double* q1, std::size_t count,
                                  WorkerPool& pool, std::vector<EdgeAnswer>& answers) const {
  FORETOUCH_CHECK(checkAll(robot(), q0, count));
  FORETOUCH_CHECK(checkAll(robot(), q1, count));
  const std::size_t n = robot().numCoordinates();
  answers.resize(count);
  return internal::runEdges(pool, count, [&](std::size_t i, Scratch& scratch) -> Result<Done> {
    answers[i] = {};
    FORETOUCH_TRY(answers[i], answer(q0 + i * n, q1 + i * n, n, scratch));
    return Done{};
  });
}

Result<PathAnswer> EdgeQuery::answerPath(const double* q, std::size_t count,
                                         WorkerPool& pool) const {
  if (count < 2) {
    return Error::in("path", ErrorCode::Empty,
                     "expected at least two configurations, found " + std::to_string(count));
  }
  FORETOUCH_CHECK(checkAll(robot(), q, count));
  const std::size_t n = robot().numCoordinates(), edges = count - 1;
  std::vector<EdgeAnswer>& answers = pool.scratch().of<internal::EdgeListMemory>().ofPath;
  answers.resize(edges);
  std::atomic<std::size_t> firstMet{edges};
  const auto ask = [&](std::size_t i, Scratch& scratch) -> Result<Done> {
    // No edge behind one that is not clear is needed.
    if (i > firstMet.load(std::memory_order_relaxed)) return Done{};
    answers[i] = {};
    FORETOUCH_TRY(answers[i], answer(q + i * n, q + (i + 1) * n, n, scratch));
    if (answers[i].verdict == Verdict::Clear) return Done{};
    std::size_t first = firstMet.load(std::memory_order_relaxed);
    while (i < first && !firstMet.compare_exchange_weak(first, i)) {
    }
    return Done{};
  };
  FORETOUCH_CHECK(internal::runEdges(pool, edges, ask));
  PathAnswer path;
  path.edge = firstMet.load(std::memory_order_relaxed);
  const bool isFree = path.edge == edges;
  path.answer = answers[isFree ? edges - 1 : path.edge];
  // Rounded down, but at the edge's own begin.
  const double until = isFree ? 0.0 : path.answer.freeUntil;
  path.freeUntil = static_cast<double>(path.edge) + until;
  if (until > 0.0) path.freeUntil = std::nextafter(path.freeUntil, static_cast<double>(path.edge));
  return path;
}

}  // namespace foretouch
