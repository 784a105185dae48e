// middleware/edges/edge_tasks.h: the edges of a list, which the threads of a pool share. Not
// installed.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "articulated/result.h"
#include "articulated/robot.h"
#include "articulated/try.h"
#include "middleware/edges/edge_query.h"
#include "middleware/query/first_failure.h"
#include "middleware/scratch.h"
#include "middleware/worker_pool.h"

namespace foretouch::internal {

/// Edges are taken in groups: adjacent answers share cache lines, and so does the counter.
inline constexpr std::size_t kEdgesAtOnce = 8;

/// What one thread keeps between lists.
struct alignas(128) EdgeListMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::EdgeList;

  FirstFailure failure{"edges"};
  std::vector<EdgeAnswer> ofPath;
};

/// task(i, scratch) for each edge, in order but for what other threads have begun; of those that
/// fail, the error of the first.
template <typename Task>
Result<Done> runEdges(WorkerPool& pool, std::size_t count, const Task& task) {
  const auto numThreads = static_cast<std::size_t>(pool.threads());
  for (std::size_t i = 0; i < numThreads; ++i) {
    pool.scratch(i).of<EdgeListMemory>().failure.clear();
  }
  std::atomic<std::size_t> next{0};
  const auto takePart = [&](std::size_t thread) {
    Scratch& scratch = pool.scratch(thread);
    const auto renew = [&] {
      for (const auto kind : {ScratchKind::Edge, ScratchKind::Query, ScratchKind::Clearance}) {
        scratch.forget(kind);
      }
    };
    for (;;) {
      const std::size_t begin = next.fetch_add(kEdgesAtOnce, std::memory_order_relaxed);
      const std::size_t end = std::min(begin + kEdgesAtOnce, count);
      for (std::size_t i = begin; i < end; ++i) {
        scratch.of<EdgeListMemory>().failure.attempt(
            i, [&] { return task(i, scratch); }, renew);
      }
      if (end >= count) return;
    }
  };
  pool.run(std::ref(takePart));  // a std::function of the lambda itself would allocate
  return FirstFailure::of(
      numThreads, [&](std::size_t i) -> const auto& {
        return pool.scratch(i).of<EdgeListMemory>().failure;
      });
}

/// All configurations, before any edge is asked.
Result<Done> checkAll(const Robot& robot, const double* q, std::size_t count);

}  // namespace foretouch::internal
