// tools/floor/in_place.h: detects a walk that stays in place, as libraries of clips for games have
// it: the engine is to move the body, and until then each foot that bears slides.
#pragma once

#include <cstdint>
#include <optional>

#include "tools/floor/floor_fit.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {

/// How fast (m/s) what bears goes by below a body that stays in its place, in poses 0 to `steps`,
/// `stepS` apart; nothing if it does not.
[[nodiscard]] std::optional<double> walksInPlace(const RestingBody& body, std::int64_t steps,
                                                 double stepS, const RestingPoses& poses);

}  // namespace foretouch::tools
