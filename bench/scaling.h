// bench/scaling.h: `foretouch-bench scaling`: how the cost of a step grows with each parameter.
#pragma once

#include <vector>

#include "bench/latency.h"
#include "bench/options.h"

namespace foretouch::tools {

/// Varies one axis at a time; the others keep the base's value. An empty list omits its axis.
struct ScalingRequest {
  BenchOptions options;
  std::size_t triangles = 300'000;  ///< Of the base; 0: the scene's own.
  int links = 16;                   ///< Of the base; 0: the avatar's own.
  double tolerance = 1e-3;          ///< Of the base (m).
  double rateHz = 5.0;              ///< Of the base.
  std::vector<int> trianglesAxis, linksAxis;
  std::vector<double> rateAxis, toleranceAxis;
  std::vector<int> avatarsAxis, threadsAxis;  ///< Crossed with each other.
  int crowdSteps = 4000;                      ///< Of all avatars together, at least.
  int crowdRepeats = 3;                       ///< The quickest counts.
};

/// Tables: "scaling", and "crowd" if there are avatars and threads.
[[nodiscard]] Result<MeasuredBench> measureScaling(const ScalingRequest& request);

}  // namespace foretouch::tools
