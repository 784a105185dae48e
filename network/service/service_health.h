// network/service/service_health.h: what a service's state means for what watches over it. Pure.
// Not installed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "network/service/health.h"
#include "network/world_stream/refused_bodies.h"

namespace foretouch::internal {

struct ServiceState {
  std::optional<Error> failure;
  struct Thread {
    std::string name;
    std::int64_t idleMs = 0;  ///< Since it last got on.
  };
  std::vector<Thread> threads;  ///< Those that answers need.
  std::int64_t unacceptedMs = 0;
  bool hasJournal = false;
  std::int64_t journalIdleMs = 0;
  std::uint64_t journalFailures = 0;
  std::string journalFailure;
  std::int64_t lastPoseUtimeUs = 0, nowUtimeUs = 0;
  std::size_t refusedBodies = 0;  ///< As WorldCounts.
  std::vector<RefusedBody> refusedLongest;
};

/// As ServiceOptions says them.
struct HealthLimits {
  std::chrono::milliseconds stuckAfter, unacceptedAfter;
};

[[nodiscard]] ServiceHealth healthOf(const ServiceState& state, const HealthLimits& limits);

}  // namespace foretouch::internal
