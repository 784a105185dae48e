// middleware/lanes/pair_floats.h: how many pairs of triangles are looked at side by side. Not
// installed.
#pragma once

#include <cstddef>

namespace foretouch::internal {

/// Pairs in a block: one vector of the widest instructions, several of the narrower ones.
inline constexpr std::size_t kTrianglePairLanes = 16;

/// A coordinate, or a bound, of every pair.
using PairFloats = float[kTrianglePairLanes];

}  // namespace foretouch::internal
