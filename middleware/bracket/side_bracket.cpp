#include "middleware/bracket/side_bracket.h"

#include <algorithm>
#include <vector>

#include "middleware/pair/link_query.h"

namespace foretouch::internal {
namespace {

/// Where growths are small at the begin and not later: a touch is found among fewer pairs in the
/// first part.
constexpr double kFirstSpan = 0.25;
/// What the search stops at and what it proves before (bracket.md 1).
struct Levels {
  double resolution, enter, floor;
};
Levels levelsOf(double resolution, bool isGrown) {
  // The shrunk body steps through its surface by the resolution at most, so that it is inside then.
  return {resolution, isGrown ? resolution : 0.0, isGrown ? kFloorShare * resolution : -resolution};
}

bool isWithin(MovingSides& sides, const SidesPair& pair, double t, double enter) {
  return sides.at(pair, t).gapUpper <= enter;
}

/// The first of the pairs that are listed is the nearest, or nearly so.
bool isSoonFound(MovingSides& sides, double t, double enter, SidesPair& witness) {
  if (!witness.isNone() && isWithin(sides, witness, t, enter)) return true;
  if (sides.limit() == nullptr || sides.limit()->empty()) return false;
  const SidesPair& nearest = sides.limit()->front();
  if (nearest == witness || !isWithin(sides, nearest, t, enter)) return false;
  witness = nearest;
  return true;
}

void set(MovingSides& sides, const Growth& growth, const BracketSearch& search) {
  sides.grow(growth, search.body == BracketSearch::Body::Grown ? 1.0 : -1.0);
  sides.turnBack(search.way == BracketSearch::Way::Backward);
}

}  // namespace

bool SideBracketer::isFound(MovingSides& sides, const Growth& growth, double resolution,
                            const BracketSearch& search, double at, const SidesPair& witness) {
  set(sides, growth, search);
  const Levels levels = levelsOf(resolution, search.body == BracketSearch::Body::Grown);
  const double t = search.way == BracketSearch::Way::Backward ? 1.0 - at : at;
  return isWithin(sides, witness, t, levels.enter);
}

std::optional<double> SideBracketer::find(MovingSides& sides, const Growth& growth,
                                          double resolution, const BracketSearch& search,
                                          double from, double to, SidesPair& witness) {
  const bool isGrown = search.body == BracketSearch::Body::Grown;
  const bool isBackward = search.way == BracketSearch::Way::Backward;
  set(sides, growth, search);
  const Levels levels = levelsOf(resolution, isGrown);
  const double begin = isBackward ? 1.0 - from : from;
  if (isSoonFound(sides, begin, levels.enter, witness)) return from;
  const IntervalTracer::Search found =
      tracer_.search(sides, {levels.enter, levels.enter, levels.enter, levels.floor}, begin,
                     isBackward ? 1.0 - to : to, growth.most() > kSmallGrowth ? kFirstSpan : 1.0,
                     witness, counters_);
  using Found = IntervalTracer::Found;
  // What doubles cannot tell apart may touch, and does not surely.
  if (found.found == Found::Nothing || (found.found == Found::Unresolved && !isGrown)) {
    return std::nullopt;
  }
  return isBackward ? 1.0 - found.t : found.t;
}

}  // namespace foretouch::internal
