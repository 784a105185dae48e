// bench/trees.h: `foretouch-bench trees`: the builders of a scene's tree beside one another.
#pragma once

#include "bench/latency.h"
#include "bench/options.h"

namespace foretouch::tools {

struct TreesRequest {
  BenchOptions options;
  std::size_t triangles = 300'000;  ///< 0: the scene's own.
  int rounds = 5;  ///< Each builder once, in turns; the least of a builder's times counts.
};

/// Table "trees": one row per builder of this library. Raw: one line per round and builder.
[[nodiscard]] Result<MeasuredBench> measureTrees(const TreesRequest& request);

}  // namespace foretouch::tools
