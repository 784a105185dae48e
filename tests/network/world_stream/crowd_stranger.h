// tests/network/world_stream/crowd_stranger.h: somebody who wants a live world to fail the others.
// He speaks of bodies of his own alone, as the service lets him: they carry each other in turns,
// announced ahead and too late, lie where the others are, and are stamped as if it were later.
#pragma once

#include <cstdint>

#include "tests/network/world_stream/crowd.h"
#include "tests/network/world_stream/crowd_told.h"

namespace foretouch::test {

/// The numbers of his bodies come after those of the crowd.
inline constexpr BodyNumber kStrangersBodies = 6;

/// Adds what he says, by time.
void addStranger(std::uint64_t seed, Crowd& crowd);

/// Takes out of what was told all that is about his bodies: they have no truth.
void leaveStranger(const Crowd& crowd, CrowdTold& told);

}  // namespace foretouch::test
