// tools/feet/rest_runs.h: what poses alone say about rest: feet that hover, and how much touches
// depend on the height of the ground.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// Runs in which no part of the foot touches, and its lowest part is above the ground by more than
/// the tolerance and at most kHighestHover, and slower than kRestSpeed, for at least kRestTimeS.
/// Uses the samples of `answer`.
[[nodiscard]] std::vector<FootStance> restRunsOf(const FeetInputs& inputs,
                                                 const FeetAnswer& answer);

/// How many touches of feet there would be, and for how long, with the body raised by `raise` (m).
struct Sensitivity {
  double raise = 0.0;
  std::int64_t touches = 0;
  double touchS = 0.0;
};
/// For some heights from 30 mm lower to 30 mm higher, by poses; for the body as it is, the proven
/// touches (foot_touches.h).
[[nodiscard]] std::vector<Sensitivity> sensitivityOf(const FeetInputs& inputs,
                                                     const FeetAnswer& answer);

}  // namespace foretouch::tools
