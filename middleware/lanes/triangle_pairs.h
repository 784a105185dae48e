// middleware/lanes/triangle_pairs.h: many pairs of triangles at once, one per float lane, each at
// its own instant: a proven bound on their separation now, and for how long it holds. The
// counterpart of movingPair(), which decides the pairs that floats leave
// open. Proof with rounding: middleware/lanes/triangle_pairs.md. Not installed.
#pragma once

#include <cstddef>

#include "middleware/lanes/pair_floats.h"

namespace foretouch::internal {

/// Pairs of a moving triangle of a link and a triangle of the scene. Metres, relative to an origin
/// of the caller's choice, one per pair: floats resolve 6e-8 of the distance between it and the
/// triangles. Velocities and accelerations are derivatives in t. Triangles without area are legal.
/// A pair gets no step if any value (coordinates: relative to the scene's first vertex) is beyond
/// 2^50, infinite or NaN, or if a pad, bound or floor is negative.
struct TrianglePairBlock {
  alignas(64) PairFloats link[3][3];       ///< [vertex][axis]
  alignas(64) PairFloats velocity[3][3];   ///< [vertex][axis] of the link's triangle.
  alignas(64) PairFloats acceleration[3];  ///< Each vertex's: at most this long, from now on.
  alignas(64) PairFloats scene[3][3];      ///< [vertex][axis]
  /// At least the points' error: the largest of the link's three plus the largest of the scene's.
  alignas(64) PairFloats positionPad;
  alignas(64) PairFloats velocityPad;  ///< At least each velocity's error.
  alignas(64) PairFloats floor;        ///< Separation that a step keeps; at least 0.
};

/// How the other side of a block's pairs moves, where it does: the triangle in `scene`. The block's
/// pads cover both sides then, each the sum of what they are for one.
struct OtherMotions {
  alignas(64) PairFloats velocity[3][3];  ///< [vertex][axis]
  alignas(64) PairFloats acceleration;    ///< Every vertex's: at most this long, from now on.
};

/// The proof for each pair. Both are 0 if nothing is proven.
struct TrianglePairSteps {
  alignas(64) PairFloats lower;  ///< The true triangles are at least this far apart now.
  /// And at least `floor` apart for this long from now, rounded down. 0 does not mean contact: only
  /// doubles decide that.
  alignas(64) PairFloats step;
};

/// Answers the first `count` pairs, at most kTrianglePairLanes; also reads and writes slots beyond,
/// up to a whole vector, which mean nothing.
void proveSteps(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps);

/// The same for pairs of which both sides move.
void proveSteps(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                TrianglePairSteps& steps);

/// The same for pairs whose link triangle is a segment, from link[0] to link[1]; does not read the
/// third vertex. Looks at three pairs of edges, not nine.
void proveSegmentSteps(const TrianglePairBlock& block, std::size_t count, TrianglePairSteps& steps);

/// The same for pairs of which both sides move; and for those whose scene's triangle is also a
/// segment, from scene[0] to scene[1]: one pair of edges.
void proveSegmentSteps(const TrianglePairBlock& block, const OtherMotions& others,
                       std::size_t count, TrianglePairSteps& steps);
void proveAxisSteps(const TrianglePairBlock& block, const OtherMotions& others, std::size_t count,
                    TrianglePairSteps& steps);

}  // namespace foretouch::internal
