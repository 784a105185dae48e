// middleware/pair/leaving.h: by which tolerance to ask again what begins within its tolerance
// without touching, so that it can leave (docs/guarantees.md 13). Not installed.
#pragma once

#include <algorithm>

#include "middleware/query_options.h"

namespace foretouch::internal {

/// QueryOptions::passSeparating: how near a link may come when it leaves, as a share of the
/// separation at t = 0.
inline constexpr double kPassShare = 0.25;
/// QueryPlan::startShare is at most this: with more, what begins apart would soon be where it may
/// not go on.
inline constexpr double kMostStartShare = 0.5;

/// For a separation at t = 0 (m) within `tolerance`: this share of it. Zero: so near that no
/// tolerance is left, the contact stands.
[[nodiscard]] inline double leavingTolerance(double separation, double tolerance, double share) {
  const double left = std::min(tolerance, share * separation);
  return separation <= tolerance && left >= kMinTolerance ? left : 0.0;
}

}  // namespace foretouch::internal
