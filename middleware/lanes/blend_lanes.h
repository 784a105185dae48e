// middleware/lanes/blend_lanes.h: points that follow a blend of several links, over a span: their
// curves as float polynomials with every error bounded, triangles of such points in float lanes,
// and the extent of a blended axis at the nodes of the span. Proof with rounding:
// middleware/lanes/blend_lanes.md. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>

#include "articulated/chain_nodes.h"
#include "middleware/lanes/triangle_pairs.h"
#include "tessellation/lss_polynomials.h"

namespace foretouch::internal {

/// A bound that is linear in the distance rho from a link's origin: origin + turn * rho.
struct ArmBound {
  float origin, turn;
};

/// A link's frame over a span, for blends. Bounds are per metre, or per metre and unit of u;
/// rounded up.
struct BlendFrame {
  FramePolynomials polynomials;
  ArmBound error;                ///< As in FramePolynomials.
  ArmBound weighted;             ///< Sum over j of (2j+2) |j-th coefficient|.
  ArmBound speed, acceleration;  ///< Those of the polynomials.
};
[[nodiscard]] BlendFrame blendFrame(const FramePolynomials& polynomials);

/// One link's share of a blended point: weight times its place as the link moves it.
struct LaneShare {
  double weight;
  float laneWeight, arm[3];  ///< The weight, and the weight times the point; rounded to nearest.
  float reach;               ///< The weight times the point's distance from the link's origin;
                             ///< rounded up.
  std::int32_t link;
};
[[nodiscard]] LaneShare laneShare(std::int32_t link, double weight, const double* p_L);

/// The shares of one point.
struct LaneBlend {
  const LaneShare* shares;
  int count;
};

/// Bounds on all blended points over a span. Metres, derivatives per unit of u; rounded up.
struct BlendBounds {
  /// On |true - evaluated|, the weights taken to add up to 1.
  float positionPad;
  /// On the error of the derivative of the polynomials as evaluated.
  float velocityPad;
  float speed, acceleration;  ///< Those of the polynomials.
  float weighted;             ///< Sum over j of (2j+2) |j-th coefficient|.
};

/// The curve of one blended point relative to an origin.
struct BlendPoint {
  float c[3][kCoefficients];  ///< Ascending powers of u.
  BlendBounds bounds;
};
/// `frames`: by link. `origin`: relative to that of the nodes, in floats, as FramePolynomials have.
[[nodiscard]] BlendPoint blendPoint(const BlendFrame* frames, const LaneBlend& blend,
                                    const double* origin);

/// The same for a triangle. Columns are [3 * corner + axis], of which the last seven mean nothing.
struct BlendTriangle {
  static constexpr int kColumns = 16;
  alignas(64) float c[kCoefficients][kColumns];
  BlendBounds bounds;
};
void blendTriangle(const BlendFrame* frames, const LaneBlend (&corners)[3], const double* origin,
                   BlendTriangle& triangle);

/// A closed box relative to the curves' origin, or one of a triangle of the scene relative to it.
struct CurveBox {
  float lower[3], upper[3];
  /// No farther apart than `reach` on any axis, or not proven so.
  [[nodiscard]] bool isNear(const CurveBox& other, float reach) const {
    bool near = true;
    for (int axis = 0; axis < 3; ++axis) {
      near = near && lower[axis] - other.upper[axis] <= reach &&
             other.lower[axis] - upper[axis] <= reach;
    }
    return near;
  }
};

/// What surrounds a triangle of points in lanes.
struct BlendHull {
  float pad;              ///< At least the error of the points' places.
  float radius;           ///< That of what they stand for: 0 for a triangle itself.
  CurveBox swept, start;  ///< Around it at every u in [-1,1], and at u = -1.
};
/// `pad` at least triangle.bounds.positionPad.
[[nodiscard]] BlendHull blendHull(const BlendTriangle& triangle, float pad, float radius);

/// Evaluates triangles[which[lane]] at u[lane] for the first `count` lanes, at most
/// kTrianglePairLanes: fills their places, velocities, accelerations and velocity pads in `pairs`.
/// Whatever proveSteps() then proves, with at least bounds.positionPad in `pairs`, holds for the
/// true triangle while its steps stay in the span.
void placeBlends(const BlendTriangle* triangles, const std::int32_t* which, const PairFloats& u,
                 std::size_t count, TrianglePairBlock& pairs);

/// One link's share of a blended axis, a segment.
struct AxisShare {
  const double* a;
  const double* b;  ///< The same as `a` if the axis is a point.
  double weight, spread;
  const LinkNodes* link;
};
/// The axis at the nodes.
struct BlendExtent {
  double least[3], most[3];  ///< Coordinates of the ends.
  double spread;  ///< The largest sum of spread times the distance between the share's ends and
                  ///< those of the first.
};
/// As computed, relative to the origin of the nodes. `count`: at least 1.
[[nodiscard]] BlendExtent blendExtent(const AxisShare* shares, int count);

}  // namespace foretouch::internal
