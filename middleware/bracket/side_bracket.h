// middleware/bracket/side_bracket.h: when the grown and the shrunk body of two sides touch in one
// piece of a motion. Proof: bracket.md 1. Not installed.
#pragma once

#include <cstdint>
#include <optional>

#include "middleware/events/interval_tracer.h"
#include "middleware/events/moving_sides.h"
#include "middleware/events/world_event.h"
#include "middleware/pair/growth.h"

namespace foretouch::internal {

/// Up to here (m) what is near in a step is few.
inline constexpr double kSmallGrowth = 5e-3;

/// Which body, and from which end of the piece.
struct BracketSearch {
  enum class Body : std::uint8_t { Grown, Shrunk };
  enum class Way : std::uint8_t { Forward, Backward };
  Body body = Body::Grown;
  Way way = Way::Forward;
};

/// For one thread; keeps its memory.
class SideBracketer {
 public:
  /// The pair alone shows that `at` is such an instant.
  [[nodiscard]] static bool isFound(MovingSides& sides, const Growth& growth, double resolution,
                                    const BracketSearch& search, double at,
                                    const SidesPair& witness);
  /// From `from` to `to`, which is before it on the way back (t of the piece, in [0,1]): the first
  /// instant at which the grown body may touch, or the shrunk one surely does; nothing: there is
  /// none. `resolution`: metres. `witness`: the pair that touches, or one to look at first.
  [[nodiscard]] std::optional<double> find(MovingSides& sides, const Growth& growth,
                                           double resolution, const BracketSearch& search,
                                           double from, double to, SidesPair& witness);

 private:
  IntervalTracer tracer_;
  EventCounters counters_;
};

}  // namespace foretouch::internal
