// middleware/solid/solid_target.h: what a solid avatar (solid_avatar.h) follows. Metres in W.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/pose.h"

namespace foretouch {

/// Where the tracker says that the avatar is.
struct SolidTarget {
  const Pose& pose;
  double dtS;  ///< Seconds since the last target, > 0 and at most 10.
  /// One per joint: 0 if its tracker lost it, so that its place in `pose` means nothing (but must
  /// be finite). Null: all are tracked. A lost joint keeps its place on its parent; a lost root
  /// stays where it is.
  const std::vector<std::uint8_t>* isTracked = nullptr;
};

}  // namespace foretouch
