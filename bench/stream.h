// bench/stream.h: measures the stream: senders in this process, `foretouch serve` in another, real
// multicast in a private network; and the same for hours, watching for growth.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "bench/report.h"
#include "bench/stream_load.h"

namespace foretouch::tools {

/// A number of senders, each with a number of poses per second.
struct StreamCrowd {
  int avatars = 1;
  double rateHz = 90.0;
};

struct StreamRequest {
  BenchFiles files;
  Placement place;
  std::vector<StreamCrowd> crowds;
  double durationS = 10.0;  ///< Duration of each crowd.
  int workers = 1;
};

/// Every crowd against a service of its own. Precondition: enterPrivateNetwork() was called.
[[nodiscard]] Result<BenchReport> measureStream(const StreamRequest& request);

struct SoakRequest {
  BenchFiles files;
  Placement place;
  std::vector<StreamCrowd> crowds;  ///< All at once.
  double minutes = 2.0;
  double warmUpShare = 0.25;   ///< Share of the time before memory is watched.
  double garbageShare = 0.01;  ///< Datagrams of garbage per pose.
  int workers = 1;
  MovingRequest moving;  ///< With balls the service has a world; calm alone.
  bool isCalm = false;   ///< Without what bench/soak_trouble.h does.
  std::string diskPath;  ///< A folder on a small disk of its own, for the service's log: it is
                         ///< filled and emptied. Empty: the log goes to a folder that is not.
};

struct SoakOutcome {
  BenchReport report;
  std::int64_t lost = 0;        ///< Poses that were not answered, or are not in the world.
  double slopeMbPerHour = 0.0;  ///< Growth of resident memory after warm-up, by least squares.
  double grownMb = 0.0;         ///< Resident memory, in the last half after warm-up.
  bool filesGrown = false;  ///< Never so few open in the last half after warm-up as in the first.
  int exitCode = -1;        ///< The service's.
};

/// One service under one load. Precondition as above.
[[nodiscard]] Result<SoakOutcome> soakStream(const SoakRequest& request);

/// Slope of `values` over `times` by least squares; 0 for fewer than two.
[[nodiscard]] double slopeOf(const std::vector<double>& times, const std::vector<double>& values);

}  // namespace foretouch::tools
