// middleware/solid/solid_way.h: the way of one tick, piece by piece. Not installed.
#pragma once

#include <algorithm>
#include <limits>

#include "middleware/solid/solid_tick.h"

namespace foretouch::internal {

/// A tick in which nothing has happened yet. Keeps its memory.
inline void beginWay(SolidTick& tick) {
  tick.numWay = 0;
  tick.clearance = std::numeric_limits<double>::infinity();
}

inline void appendPiece(const Pose& reached, double clearance, SolidTick& tick) {
  if (tick.way.size() == tick.numWay) tick.way.emplace_back();
  tick.way[tick.numWay++] = reached;
  tick.clearance = std::min(tick.clearance, clearance);
}

}  // namespace foretouch::internal
