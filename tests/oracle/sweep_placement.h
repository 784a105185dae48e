// tests/oracle/sweep_placement.h: places in a scene where a clip meets something now and then.
#pragma once

#include <vector>

#include "tests/oracle/sweep_inputs.h"

namespace foretouch::test {

/// At most `count` placements, the same for the same clip and scene: drawn over the scene's floor
/// area onto whatever lies there (floors, tables, slopes), and kept if a quick probe shows contact
/// in 5 to 60 % of its steps. Where too few are in that band, the nearest to it fill up.
[[nodiscard]] std::vector<Placement> choosePlacements(const SweepClip& clip,
                                                      const SweepScene& scene, int count);

}  // namespace foretouch::test
