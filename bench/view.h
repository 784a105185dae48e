// bench/view.h: the cost of viewers for a service: the stream of bench/stream.h with a number of
// viewers reading, and their delays.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"
#include "bench/stream.h"

namespace foretouch::tools {

struct ViewRequest {
  BenchFiles files;
  Placement place;
  StreamCrowd crowd;
  std::vector<int> viewers;  ///< Of each row; 0: nobody looks.
  double durationS = 10.0;   ///< Of each run.
  int repeats = 3;           ///< Of all rows, in turn.
  int workers = 1;
  std::string command;  ///< As typed in.
};

/// A row without a view at all, then one for each number of viewers, each run against a service of
/// its own. Precondition: enterPrivateNetwork() was called.
[[nodiscard]] Result<StreamBench> measureView(const ViewRequest& request);

}  // namespace foretouch::tools
