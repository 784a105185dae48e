// lss/safe_step.h: how long a clearance that changes at a bounded rate lasts. Not installed.
#pragma once

#include <cmath>
#include <limits>

#include "lss/assert.h"

namespace foretouch::internal {

/// Largest s >= 0, rounded down, such that clearance + s*speed - acceleration*s^2/2 >= 0 on all of
/// [0, s]; infinity if it never falls below. `clearance` > 0, `acceleration` >= 0; `speed` is the
/// rate at which the clearance grows (negative: closing).
[[nodiscard]] inline double safeStep(double clearance, double speed, double acceleration) {
  // Rounds down past the rounding of the formula (some ten roundings of positive terms).
  constexpr double kStepShrink = 1.0 - 1e-12;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  FORETOUCH_ASSERT(clearance > 0.0 && acceleration >= 0.0);
  const double root = std::sqrt(speed * speed + 2.0 * acceleration * clearance);
  // Two forms of the positive root, each a sum of terms of one sign.
  if (speed <= 0.0) {
    const double closing = root - speed;
    return closing > 0.0 ? kStepShrink * (2.0 * clearance / closing) : kNever;
  }
  return acceleration > 0.0 ? kStepShrink * ((speed + root) / acceleration) : kNever;
}

}  // namespace foretouch::internal
