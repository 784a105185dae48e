// middleware/lanes/triangle_pairs.h: many pairs of triangles at once, one a float lane, each at its
// own instant: what is proven of their separation now, and for how long. The counterpart of
// triangleSeparation() and stepFrom(), which answer what the floats leave open. Proof with
// rounding: middleware/lanes/triangle_pairs.md. Not installed.
#pragma once

#include <cstddef>

namespace foretouch::internal {

/// Pairs in a block: one vector of the widest instructions, several of the narrower ones.
inline constexpr std::size_t kTrianglePairLanes = 16;

/// A coordinate, or a bound, of every pair.
using PairFloats = float[kTrianglePairLanes];

/// Pairs of a moving triangle of a link and a triangle of the scene. Metres, relative to an origin
/// of the caller's choice, one a pair: floats resolve 6e-8 of what is between it and the triangles.
/// Velocities and accelerations are derivatives in t. Triangles without area are legal. A pair
/// in which anything (coordinates: from the scene's first vertex) is beyond 2^50, infinite or not a
/// number gets no step, nor does one with a negative pad, bound or floor.
struct TrianglePairBlock {
  alignas(64) PairFloats link[3][3];       ///< [vertex][axis]
  alignas(64) PairFloats velocity[3][3];   ///< [vertex][axis] of the link's triangle.
  alignas(64) PairFloats acceleration[3];  ///< Of each vertex: at most this long, from now on.
  alignas(64) PairFloats scene[3][3];      ///< [vertex][axis]
  /// What the points may be off, at least: the largest of the link's three and the largest of the
  /// scene's, added.
  alignas(64) PairFloats positionPad;
  alignas(64) PairFloats velocityPad;  ///< What each velocity may be off, at least.
  alignas(64) PairFloats floor;        ///< Separation that a step keeps; at least 0.
};

/// What is proven of each pair. Both are 0 where nothing is.
struct TrianglePairSteps {
  alignas(64) PairFloats lower;  ///< The true triangles are at least this far apart now.
  /// And at least `floor` apart for this long from now, rounded down. 0 does not mean contact: that
  /// is for doubles to say.
  alignas(64) PairFloats step;
};

/// Answers the first `count` pairs, at most kTrianglePairLanes; the other slots are read and
/// written too, as far as whole vectors need it, and mean nothing.
void proveSteps(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps);

/// The same of pairs whose link triangle is a segment, from link[0] to link[1]; nothing is read of
/// the third vertex. Looks at three pairs of edges, not nine.
void proveSegmentSteps(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps);

}  // namespace foretouch::internal
