// bench/hardening.h: what the flags of packages cost: the C library and the service of a hardened
// build beside those of this one, in one run.
#pragma once

#include <string>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "bench/report.h"
#include "bench/stream_load.h"

namespace foretouch::tools {

struct HardeningRequest {
  std::string folder;  ///< The hardened build: bin/foretouch and bindings/c/libforetouch.so in it.
  double seconds = 5.0;  ///< Of each table.
};

/// Both libraries answer the same poses of the clip, one after the other and in changing order, in
/// this process. Errors: a library that cannot be loaded, answers that differ.
[[nodiscard]] Result<BenchTable> hardenedQueries(const HardeningRequest& request,
                                                 const BenchInputs& inputs, const Placement& place);
/// Both services answer a sender of 1 kHz each, at the same time. Precondition:
/// enterPrivateNetwork() was called.
[[nodiscard]] Result<BenchTable> hardenedServices(const HardeningRequest& request,
                                                  const BenchInputs& inputs,
                                                  const LoadTrack& track);

}  // namespace foretouch::tools
