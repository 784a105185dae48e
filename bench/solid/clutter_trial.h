// bench/solid/clutter_trial.h: an arm that is sent from one free place to another among shelves:
// how often is it there within a second?
#pragma once

#include <cstdint>
#include <vector>

#include "bench/solid/feel.h"
#include "bench/solid/figure.h"

namespace foretouch::tools {

/// Clutter in front of the figure: two shelves, a back wall, a partition, a pole of 2 cm, a box.
[[nodiscard]] RawScene clutter();

struct ClutterTally {
  std::uint64_t goals = 0;
  std::uint64_t straight = 0;  ///< Goals to which the straight motion from the last one is free.
  std::uint64_t reached = 0;   ///< Shown is the goal, bit for bit, a second after it was set.
  std::uint64_t untold = 0;    ///< Not reached, and the state does not say that something holds it.
  std::vector<double> us;      ///< Per tick.
  WayTally way;
};

/// Sends the right arm of figure() to `goals` random poses that the judge finds free by the
/// tolerance of 0.5 mm. The tracked arm goes there straight, through everything, in a third of a
/// second, and stays there for two thirds; 90 ticks each.
[[nodiscard]] Result<ClutterTally> tryClutter(Follower& follower, int goals, std::uint64_t seed);

}  // namespace foretouch::tools
