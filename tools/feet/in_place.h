// tools/feet/in_place.h: a walk without way, as libraries of clips for games have it: the engine is
// to move the body, and until then each foot that bears slides.
#pragma once

#include <optional>

#include "tools/feet/feet_inputs.h"

namespace foretouch::tools {

/// How fast (m/s) what bears goes by below a body that stays in its place; nothing if it does not.
[[nodiscard]] std::optional<double> walksInPlace(const FeetInputs& inputs);

}  // namespace foretouch::tools
