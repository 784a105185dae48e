// tests/network/world_stream/crowd_simulation.h: one seed of a live world over a faulty network: a
// small crowd is drawn, told, judged, and told again as a replay would.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/network/world_stream/crowd_judge.h"

namespace foretouch::test {

struct CrowdRun {
  CrowdTally tally;
  std::vector<std::string> violations;  ///< The first of them.
  bool isFaulty = false;                ///< Something is lost, delayed or repeated.
};

/// `hasStranger`: somebody wants it to fail (crowd_stranger.h).
[[nodiscard]] CrowdRun simulateCrowd(std::uint64_t seed,
                                     CrowdMutation mutation = CrowdMutation::None,
                                     bool hasStranger = false);

}  // namespace foretouch::test
