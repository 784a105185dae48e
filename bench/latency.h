// bench/latency.h: `foretouch-bench latency`: the time of a step.
#pragma once

#include <vector>

#include "bench/options.h"
#include "bench/report.h"

namespace foretouch::tools {

struct LatencyRequest {
  BenchOptions options;
  std::vector<double> ratesHz = {5.0}, tolerances = {1e-3};
  std::vector<Simd> widths;   ///< At least one.
  int links = 0;              ///< 0: the avatar's own.
  std::size_t triangles = 0;  ///< 0: the scene's own.
  bool self = false;          ///< Also with the avatar's own links.
};

struct MeasuredBench {
  BenchReport report;
  BenchTable raw;  ///< One line per step.
};

/// Tables: "latency" (percentiles), "ratios" (between its rows, if there are several), "counters"
/// (means per step).
[[nodiscard]] Result<MeasuredBench> measureLatency(const LatencyRequest& request);

}  // namespace foretouch::tools
