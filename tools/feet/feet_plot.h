// tools/feet/feet_plot.h: how feet rest, drawn: a page for a browser that needs nothing else.
#pragma once

#include <string>

#include "tools/feet/feet_answer.h"
#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// A lane over time for each part, with what it touches, hovers over and sinks into; and the
/// slides as traces on the ground, seen from above.
[[nodiscard]] std::string feetPage(const FeetInputs& inputs, const FeetAnswer& answer);

}  // namespace foretouch::tools
