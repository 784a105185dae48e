#include "middleware/bracket/side_bracket.h"

#include "middleware/pair/link_query.h"

namespace foretouch::internal {

std::optional<double> SideBracketer::find(MovingSides& sides, const Growth& growth,
                                          const BracketSearch& search, double from,
                                          SidesPair& witness) {
  const bool isGrown = search.body == BracketSearch::Body::Grown;
  const bool isBackward = search.way == BracketSearch::Way::Backward;
  sides.grow(growth, isGrown ? 1.0 : -1.0);
  sides.turnBack(isBackward);
  // The shrunk body steps through its surface by the resolution at most, so that it is inside then.
  const double enter = isGrown ? resolution_ : 0.0;
  const double floor = isGrown ? kFloorShare * resolution_ : -resolution_;
  const IntervalTracer::Search found = tracer_.search(
      sides, {enter, enter, enter, floor}, isBackward ? 1.0 - from : from, witness, counters_);
  using Found = IntervalTracer::Found;
  // What doubles cannot tell apart may touch, and does not surely.
  if (found.found == Found::Nothing || (found.found == Found::Unresolved && !isGrown)) {
    return std::nullopt;
  }
  return isBackward ? 1.0 - found.t : found.t;
}

}  // namespace foretouch::internal
