// network/world_stream/carrier_times.h: which body carries which, and when, by all that was said of
// the bodies of a live world: what the world has been told, and what waits. Not installed.
#pragma once

#include <cstdint>

#include "network/wire/messages.h"
#include "network/world_stream/live_body.h"

namespace foretouch::internal {

/// Why `carrier` may not carry the body from `sinceUs` on: it would then hang on the body at some
/// instant (CarrierLoop), or more than kMostCarriers would hang on one another (Limit), or one of
/// those above it is not there (UnknownBody). None: it may.
/// O(changes of all bodies), and with each that hangs above or below it.
[[nodiscard]] Reject carrierFault(const LiveBodies& bodies, BodyNumber body, BodyNumber carrier,
                                  std::int64_t sinceUs);

/// Whether a link of a body (kEveryLink: any) is unknown in [fromUs, toUs], by what the world has
/// been told of it, or of what carries it. O(carriers).
[[nodiscard]] bool isUnknown(const LiveBodies& bodies, BodyNumber body, LinkId link,
                             std::int64_t fromUs, std::int64_t toUs);

}  // namespace foretouch::internal
