// tools/report/view_feet.h: how the feet of a replay rest, as its page shows it.
#pragma once

#include <cstdint>

#include "tools/inputs/replay_inputs.h"
#include "tools/report/view_document.h"

namespace foretouch::tools {

/// Adds the feet of the only avatar, as `foretouch feet` finds them in the replay's first `steps`
/// steps; nothing if no joint is called a foot. What cannot be followed becomes a note.
void addFeet(const ReplayInputs& inputs, std::int64_t steps, ViewDocument& document);

}  // namespace foretouch::tools
