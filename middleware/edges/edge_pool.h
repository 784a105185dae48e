// middleware/edges/edge_pool.h: many edges on a fixed set of threads. An edge takes no lock and,
// once the threads' memory has grown, allocates nothing; the answers are the same, byte for byte,
// for any number of threads.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "articulated/result.h"
#include "middleware/edges/edge_query.h"
#include "middleware/query/query_pool.h"

namespace foretouch {

/// How far a path is free: a list of configurations, with an edge from each to the next.
struct PathAnswer {
  std::size_t edge = 0;  ///< The first edge that is not Clear; the number of edges: all are.
  /// The path keeps its clearance on [0, freeUntil), never too late: `edge` plus how far that one
  /// is free. The number of edges if all are Clear.
  double freeUntil = 0.0;
  EdgeAnswer answer;  ///< Of that edge; of the last one if all are Clear.
};

class EdgePool {
 public:
  /// `threads` in [1, kMaxPoolThreads], the calling one among them. Errors: a number out of range,
  /// or the system refuses the threads.
  static Result<EdgePool> start(int threads);
  ~EdgePool();
  EdgePool(EdgePool&&) noexcept;
  EdgePool& operator=(EdgePool&&) noexcept;

  [[nodiscard]] int threads() const;

  /// `count` edges: q0 and q1 each hold `count` configurations one after the other, of
  /// `edges.robot().numCoordinates()` numbers. Resizes `answers`. Errors: as EdgeQuery::answer() of
  /// the first edge with one (Error::index is the edge), before any is asked; memory runs out: then
  /// the edges that were broken off are Undecided from 0. Not for two threads at once.
  Result<Done> answer(const EdgeQuery& edges, const double* q0, const double* q1, std::size_t count,
                      std::vector<EdgeAnswer>& answers);
  /// `count` configurations one after the other, at least two. Asks no more edges than lie before
  /// the first one that is not Clear, but for those that other threads have begun. Errors as above.
  Result<PathAnswer> answerPath(const EdgeQuery& edges, const double* q, std::size_t count);

 private:
  struct Impl;
  explicit EdgePool(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
