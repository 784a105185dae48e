#include "middleware/bracket/person_growth.h"

#include <algorithm>
#include <cmath>

#include "lss/rounding.h"

namespace foretouch::internal {

bool isSaid(double growth) {
  constexpr double kMostSaid = 10.0;  // m
  return growth <= kMostSaid;
}

std::optional<StepGrowth> StepGrowth::of(const LinkBound& bound, double seconds, double bend) {
  double most = 0.125 * bound.acceleration * seconds * seconds;
  // Nothing is claimed by a share of what is not known, be it a share of 0.
  if (std::isfinite(bend)) most = std::min(most, bound.followFloor + bound.followShare * bend);
  if (!isSaid(bound.error + most)) return std::nullopt;
  return StepGrowth{bound.error, most * kInflation};
}

Growth StepGrowth::in(double begin, double end, double stray) const {
  const double span = end - begin;
  Growth growth;
  growth.constant = (error + 4.0 * most * begin * (1.0 - begin)) * kInflation + kUnderflow;
  growth.linear = 4.0 * (most * span * (1.0 - 2.0 * begin) + stray);
  growth.square = -4.0 * (most * span * span + stray);
  return growth;
}

}  // namespace foretouch::internal
