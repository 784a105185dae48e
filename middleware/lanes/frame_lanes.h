// middleware/lanes/frame_lanes.h: points of a moving link in float lanes, each lane at its own
// instant, as proveSteps() takes them: places, velocities, and what bounds how they go on. Proof
// with rounding: middleware/lanes/frame_lanes.md. Not installed.
#pragma once

#include <array>
#include <cstddef>

#include "lss/lss.h"
#include "lss/triangle.h"
#include "middleware/lanes/triangle_pairs.h"
#include "tessellation/lss_polynomials.h"

namespace foretouch::internal {

/// What underflow may lose of a place (m), or of a rate (m per u).
inline constexpr double kFrameUnderflow = 0x1p-90;

/// A link's frame over a span as the lanes take it. Metres; derivatives per unit of u.
struct LaneFrame {
  float R[9][kCoefficients], p[3][kCoefficients];  ///< As in FramePolynomials.
  /// A point at distance rho from the link's origin is off by at most origin + turn*rho in place
  /// and, as a derivative of the polynomials, in velocity; and its acceleration is at most that of
  /// the third pair. Rounded up.
  float originPad, turnPad;
  float originVelocityPad, turnVelocityPad;
  float originAcceleration, turnAcceleration;
};
[[nodiscard]] LaneFrame laneFrame(const FramePolynomials& polynomials);

/// A convex part of a link: the hull of three points fixed in it, grown by `radius`.
struct LanePart {
  float point[3][3];  ///< [point][axis], rounded to nearest; of an LSS the second end twice.
  float rho;          ///< No point, unrounded, is farther from the link's origin. Rounded up.
  float radius;       ///< Rounded up.
};
[[nodiscard]] LanePart lanePart(const Triangle& triangle_L);
[[nodiscard]] LanePart lanePart(const Lss& lss_L);

/// One part a lane, and when.
struct PartBlock {
  alignas(64) PairFloats u;            ///< In [-1,1].
  alignas(64) PairFloats point[3][3];  ///< As in LanePart.
  alignas(64) PairFloats rho;
  alignas(64) PairFloats scenePad;  ///< What the scene's vertices in the lane are off, at least.
};

/// Places the first `count` lanes' parts, at most kTrianglePairLanes, relative to the polynomials'
/// origin: fills all of `pairs` but `scene` and `floor`. Whatever proveSteps() then proves holds of
/// the true link for as long as its steps stay in the span. Slots beyond `count` are read and
/// written as far as whole vectors need it.
void placeParts(const LaneFrame& frame, const PartBlock& parts, std::size_t count,
                TrianglePairBlock& pairs);

}  // namespace foretouch::internal
