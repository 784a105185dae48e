// examples/throw.h: a ball that leaves the dancer's hand, flies and bounces, as a table of poses.
#pragma once

#include <string>

#include "articulated/avatar.h"

namespace foretouch::examples {

/// The ball's radius (m), and its middle in the frame of the right hand: below the palm.
inline constexpr double kBallRadius = 0.07;
inline constexpr double kBallInHand[3] = {-0.05, -0.117, 0.0};
/// When the hand lets it go (s).
inline constexpr double kThrowS = 5.5;

/// `time,x,y,z`: from the throw to the end of the dance, 120 times per second; to 10 micrometres.
[[nodiscard]] std::string throwText(const Avatar& dancer);

}  // namespace foretouch::examples
