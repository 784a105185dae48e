// bench/trust.h: what strangers can do to a service, in figures: floods beside a true sender, slow
// clients of HTTP, a log under refused poses, and what it costs to know who speaks and to be
// hardened.
#pragma once

#include <string>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "bench/report.h"

namespace foretouch::tools {

struct TrustRequest {
  BenchFiles files;
  Placement place;
  double seconds = 5.0;  ///< Of each row.
  std::string hardened;  ///< The folder of a hardened build; empty: without its tables.
  std::string command;   ///< As typed in.
};

struct TrustBench {
  BenchReport report;
  std::int64_t lost = 0;  ///< True poses, of all floods, without an answer.
};

/// Tables: "floods", "http", "log", "speaker", and with a hardened build "hardened_queries" and
/// "hardened_services". Precondition: enterPrivateNetwork() was called.
[[nodiscard]] Result<TrustBench> measureTrust(const TrustRequest& request);

}  // namespace foretouch::tools
