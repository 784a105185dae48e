// middleware/solid/solid_way.h: the way of one tick, piece by piece. Not installed.
#pragma once

#include <algorithm>
#include <limits>

#include "middleware/solid/solid_tick.h"

namespace foretouch::internal {

/// A tick in which nothing has happened yet. Keeps its memory.
inline void beginTick(SolidTick& tick) {
  tick.numWay = 0;
  tick.clearance = std::numeric_limits<double>::infinity();
  tick.hasAppeared = false;
  tick.contacts.clear();
  tick.limit = SolidLimit::None;
  tick.snapInS = -1.0;
  tick.lift = 0.0;
  tick.counters = {};
}

inline void appendPiece(const Pose& reached, double clearance, SolidTick& tick) {
  if (tick.way.size() == tick.numWay) tick.way.emplace_back();
  tick.way[tick.numWay++] = reached;
  tick.clearance = std::min(tick.clearance, clearance);
}

/// When each piece ends: all take as long, and where the avatar appeared is the tick's begin.
inline void spreadTimes(SolidTick& tick) {
  const std::size_t first = tick.hasAppeared ? 1 : 0;
  tick.times.resize(tick.numWay);
  for (std::size_t i = 0; i < tick.numWay; ++i) {
    tick.times[i] =
        i < first ? 0.0
                  : static_cast<double>(i + 1 - first) / static_cast<double>(tick.numWay - first);
  }
}

}  // namespace foretouch::internal
