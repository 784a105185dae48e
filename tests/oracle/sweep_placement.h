// tests/oracle/sweep_placement.h: places in a scene where a clip has contacts now and then.
#pragma once

#include <vector>

#include "tests/oracle/sweep_inputs.h"

namespace foretouch::test {

/// At most `count` placements, the same for the same clip and scene: draws them over the scene's
/// floor area, onto whatever is there (floors, tables, slopes), and keeps those with contact in 5
/// to 60 % of their steps in a quick probe. If too few are in that band, the nearest to it fill up.
[[nodiscard]] std::vector<Placement> choosePlacements(const SweepClip& clip,
                                                      const SweepScene& scene, int count);

}  // namespace foretouch::test
