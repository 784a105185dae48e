// middleware/depth/world_depth.h: how deep a body of a world is in another, or in what stands
// still, at an instant, and which way out. Metres in W, world time in microseconds. The promise:
// docs/guarantees.md 18.
#pragma once

#include <cstdint>

#include "middleware/depth/depth.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// Who is moved, and out of whom: whole bodies, or a link of each.
struct DepthQuestion {
  BodyId a = 0;
  LinkId linkOfA = kEveryLink;
  BodyId b = kStillScene;
  LinkId linkOfB = kEveryLink;
};

struct WorldDepth {
  Depth depth;  ///< Of a, which `depth.wayOut` moves, in W; the bounds hold where they truly are.
  /// The deepest pair, without witness points; of no pair, the bodies that were asked.
  ContactSide a, b;
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

}  // namespace foretouch
