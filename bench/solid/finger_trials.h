// bench/solid/finger_trials.h: two hands of 26 joints each, as OpenXR has them, that grasp, press,
// drum, slide along an edge, and clap: what is shown, and what a tick costs. Metres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::tools {

struct FingerTally {
  std::string task;
  std::size_t links = 0, triangles = 0;
  std::uint64_t ticks = 0;
  std::vector<double> contactUs;  ///< Per tick in contact.
  std::vector<double> offM;       ///< Per tick: for the end of an LSS that is farthest off.
  std::uint64_t queries = 0;
  std::uint64_t equal = 0;  ///< Ticks that show what is tracked.
  WayTally way;
};

/// Both hands, open, palms down, 20 cm apart, fingers along -z.
[[nodiscard]] Avatar handPair();

/// Each task for some seconds, at 90 Hz, among some 100,000 triangles.
[[nodiscard]] Result<std::vector<FingerTally>> tryFingers(const SolidOptions& options);

}  // namespace foretouch::tools
