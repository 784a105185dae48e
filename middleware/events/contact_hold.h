// middleware/events/contact_hold.h: for how long two convex parts that are in contact now are
// proven to stay so. Proofs: events.md 2 and 3. Not installed.
#pragma once

#include "middleware/pair/moving_pair.h"

namespace foretouch::internal {

/// The largest time found, at most `rest`, for which two material points of the parts stay within
/// `limit` (m) of each other, beyond the radii; 0 if they are not proven to be so now. O(1).
[[nodiscard]] double staysWithin(const MovingPair& pair, double limit, double rest);

/// The same for an edge of one of the two that goes through the triangle of the other: it stays in
/// it. 0 if none is proven to go through one now. O(1).
[[nodiscard]] double staysPierced(const MovingPair& pair, double rest);

}  // namespace foretouch::internal
