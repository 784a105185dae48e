// assets/bvh/bvh_limits.h: the limits of BVH files, and of other clips that are read. Not
// installed.
#pragma once

#include <cstddef>

namespace foretouch {

/// Limits beyond which the reader refuses a file, before it allocates memory for it.
inline constexpr std::size_t kMaxBvhFileBytes = std::size_t{1} << 30;
/// Frames x channels. A joint counts as at least three channels, since it has a pose in every
/// frame.
inline constexpr std::size_t kMaxBvhValues = std::size_t{1} << 26;
inline constexpr std::size_t kMaxBvhToken = 4096;  ///< bytes of one word
/// Degrees; 2777 turns. Unwrapped angles grow beyond 360, but at this one degrees still resolve
/// 1e-10.
inline constexpr double kMaxBvhAngleDeg = 1e6;
/// Seconds between frames: from a microsecond, the unit of times, to an hour.
inline constexpr double kMinFrameTimeS = 1e-6;
inline constexpr double kMaxFrameTimeS = 3600.0;

}  // namespace foretouch
