#include "middleware/bracket/side_bracket.h"

#include <algorithm>
#include <vector>

#include "middleware/pair/link_query.h"

namespace foretouch::internal {
namespace {

/// Of sides that are limited to few pairs: a limb inside something meets most of them, and so many
/// looks find that out. Of others, where growths are small at the begin and not later: there a
/// touch is found among fewer pairs in the first part.
constexpr std::size_t kFirstLooks = 16;
constexpr double kFirstSpan = 0.25;
/// Of a growth: what a bracket is wide anyway need not be told to its last digit.
constexpr double kResolutionShare = 1.0 / 1024.0;

bool isSoonFound(MovingSides& sides, double t, double enter, SidesPair& witness) {
  const auto isWithin = [&](const SidesPair& pair) { return sides.at(pair, t).gapUpper <= enter; };
  if (!witness.isNone() && isWithin(witness)) return true;
  if (sides.limit() == nullptr) return false;
  const std::vector<SidesPair>& near = *sides.limit();
  const std::size_t stride = near.size() / kFirstLooks + 1;
  for (std::size_t i = 0; i < near.size(); i += stride) {
    if (!isWithin(near[i])) continue;
    witness = near[i];
    return true;
  }
  return false;
}

}  // namespace

std::optional<double> SideBracketer::find(MovingSides& sides, const Growth& growth,
                                          double resolution, const BracketSearch& search,
                                          double from, SidesPair& witness) {
  const bool isGrown = search.body == BracketSearch::Body::Grown;
  const bool isBackward = search.way == BracketSearch::Way::Backward;
  sides.grow(growth, isGrown ? 1.0 : -1.0);
  sides.turnBack(isBackward);
  // The shrunk body steps through its surface by the resolution at most, so that it is inside then.
  resolution = std::max(resolution, kResolutionShare * growth.most());
  const double enter = isGrown ? resolution : 0.0;
  const double floor = isGrown ? kFloorShare * resolution : -resolution;
  const double begin = isBackward ? 1.0 - from : from;
  if (isSoonFound(sides, begin, enter, witness)) return from;
  const IntervalTracer::Search found =
      tracer_.search(sides, {enter, enter, enter, floor}, begin,
                     growth.most() > kSmallGrowth ? kFirstSpan : 1.0, witness, counters_);
  using Found = IntervalTracer::Found;
  // What doubles cannot tell apart may touch, and does not surely.
  if (found.found == Found::Nothing || (found.found == Found::Unresolved && !isGrown)) {
    return std::nullopt;
  }
  return isBackward ? 1.0 - found.t : found.t;
}

}  // namespace foretouch::internal
