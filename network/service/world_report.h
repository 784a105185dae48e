// network/service/world_report.h: what a service's moving world has done since it started, as plain
// values. Not installed.
#pragma once

#include "network/service/latency_histogram.h"
#include "network/world_stream/world_counts.h"

namespace foretouch {

struct WorldTimes {
  /// From the receipt of the message that let the watermark advance to handing its events over.
  LatencyHistogram latency;
  /// The same from where the world was told of that message: asking, encoding and sending.
  LatencyHistogram advance;
};

struct WorldReport {
  WorldCounts counts;
  WorldTimes times;
};

}  // namespace foretouch
