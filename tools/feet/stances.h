// tools/feet/stances.h: finds how each foot and hand rests in a clip.
#pragma once

#include <cstdint>
#include <functional>

#include "articulated/result.h"
#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// Calls `progress(done)` after each step; false stops, and the answer is then of no use. Errors:
/// those of partContactsOf().
[[nodiscard]] Result<FeetAnswer> stancesOf(const FeetInputs& inputs,
                                           const std::function<bool(std::int64_t)>& progress);

}  // namespace foretouch::tools
