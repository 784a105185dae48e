// middleware/lanes/frame_lanes.h: points of a moving link in float lanes, each lane at its own
// instant, in the form of proveSteps(): places, velocities, and bounds on their further motion.
// Proof with rounding: middleware/lanes/frame_lanes.md. Not installed.
#pragma once

#include <array>
#include <cstddef>

#include "lss/lss.h"
#include "middleware/lanes/triangle_pairs.h"
#include "tessellation/lss_polynomials.h"

namespace foretouch::internal {

/// Underflow may cost a place (m) or a rate (m per u) this much.
inline constexpr double kFrameUnderflow = 0x1p-90;

/// A link's frame over a span in the form for lanes. Metres; derivatives per unit of u.
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
  float point[3][3];  ///< [point][axis], rounded to nearest; for an LSS the second end twice.
  float rho;          ///< No unrounded point is farther from the link's origin. Rounded up.
  float radius;       ///< Rounded up.
};
[[nodiscard]] LanePart lanePart(const Triangle& triangle_L);
[[nodiscard]] LanePart lanePart(const Lss& lss_L);

/// One part per lane, and its instant.
struct PartBlock {
  alignas(64) PairFloats u;            ///< In [-1,1].
  alignas(64) PairFloats point[3][3];  ///< As in LanePart.
  alignas(64) PairFloats rho;
  alignas(64) PairFloats scenePad;  ///< At least the error of the lane's scene vertices.
};

/// Places the first `count` lanes' parts, at most kTrianglePairLanes, relative to the polynomials'
/// origin: fills all of `pairs` but `scene` and `floor`. Whatever proveSteps() then proves holds
/// for the true link while its steps stay in the span. Reads and writes slots beyond `count` up to
/// a whole vector.
void placeParts(const LaneFrame& frame, const PartBlock& parts, std::size_t count,
                TrianglePairBlock& pairs);

}  // namespace foretouch::internal
