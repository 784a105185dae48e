// bench/person/ahead_trial.h: what is said before it happens, judged: at each given pose, when a
// link may touch the scene first, by chains of joints and by capsules; and when it did. Metres,
// seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/person/ahead_ways.h"
#include "bench/person/bounded_person.h"
#include "bench/solid/stage.h"

namespace foretouch::tools {

struct AheadTally {
  std::uint64_t asked = 0;    ///< Links at poses that touch nothing there.
  std::uint64_t touched = 0;  ///< Those of them that touch within the horizon.
  std::uint64_t late = 0;     ///< Said to be free for longer than they were.
  std::uint64_t alarms = 0;   ///< Said to touch, perhaps, within the horizon, and did not.
  std::vector<double>
      earlyMs;  ///< For those that touched: how much before it was said to be possible.
  std::uint64_t poses = 0;
  double us = 0.0;  ///< Of all poses; none for capsules.

  void add(const AheadTally& other);
};

struct AheadTrial {
  double rateHz = 30.0;  ///< The rate of given poses.
  double horizonS = 0.3;
};

/// One tally per way, in their order. Every way has the bounds that hold on the clip.
[[nodiscard]] std::vector<AheadTally> judgeAhead(const SolidStage& stage, const SolidActor& actor,
                                                 const Placement& place, const AheadTrial& trial);

}  // namespace foretouch::tools
