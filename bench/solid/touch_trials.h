// bench/solid/touch_trials.h: a hand at a wall: does it slide, does it rest, how does the push
// change, and what else moves? Lengths in metres.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::tools {

/// The figure's right hand is led along a wall, 10 cm inside, over 0.66 m at 0.74 m/s.
struct SlideTally {
  std::vector<double> ratio;  ///< Per tick in contact: tangential speed of the hand's tip, shown by
                              ///< tracked.
  std::vector<Pose> shown;    ///< Per tick.
  WayTally way;
};
/// `fineness`: the wall has 2 fineness^2 triangles.
[[nodiscard]] Result<SlideTally> trySlide(const SolidOptions& options, double rateHz, int fineness);

/// The figure's right hand is pressed into a wall, 1 mm per tick until it is 10 cm inside, and
/// back.
struct PressTally {
  double mostPush = 0.0;      ///< Length of the vector sum of all pushes.
  double mostJump = 0.0;      ///< Change of that sum between two ticks.
  double mostSlantDeg = 0.0;  ///< Angle of a push to the wall's normal.
  std::uint64_t untrue = 0;   ///< Ticks that are equal and push, or are held away and do not.
  double otherLinks = 0.0;    ///< Deviation of any link beyond the arm at 10 cm.
  double head = 0.0;          ///< Deviation of the head.
  std::uint64_t ticks = 0;
  WayTally way;
};
[[nodiscard]] Result<PressTally> tryPress(const SolidOptions& options);

}  // namespace foretouch::tools
