// tools/replay/touch_words.h: a replay's touches in words and as a table, for people.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/inputs/replay_inputs.h"
#include "tools/touches/touch.h"

namespace foretouch::tools {

/// The touches of one link, counted.
struct LinkTouches {
  TouchCounts counts;
  double longestS = 0.0;  ///< Between the first and the last instant at which contact is known.
};

/// "The dancer touches the room 137 times. Checking the poses alone would miss 87 of them.", and
/// a sentence each on the ground and on own links. One line each.
[[nodiscard]] std::string touchHeadline(const ReplayInputs& inputs, const TouchCounts& counts);

/// A row per link that touches anything, those with the most touches first; empty if none does.
[[nodiscard]] std::string touchTable(const Skeleton& skeleton,
                                     const std::vector<LinkTouches>& ofLink);

}  // namespace foretouch::tools
