#include "middleware/pair/still_axis.h"

#include <algorithm>

#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// The rounding of a coordinate that becomes a float, with as much to spare.
constexpr double kToFloat = 2.0 * kUnitRoundoffOfFloat;
/// The rounding of a matrix times a difference, in double.
constexpr double kTurned = 32.0 * kUnitRoundoff;
/// Lengths change by once the rotation's rounding when the computed matrix is applied, and its
/// transpose differs by twice as much from its inverse; one is to spare.
constexpr double kTurns = 4.0;

}  // namespace

StillAxis stillAxis(const Lss& lss, const LinkState& own, const AxisBounds& bounds,
                    const LinkState& mesh, const MotionBounds& boundsOfMesh) {
  const Eigen::Vector3d ends[2] = {mesh.R_WL.transpose() * (own.pointAt(lss.a) - mesh.p_WL),
                                   mesh.R_WL.transpose() * (own.pointAt(lss.b) - mesh.p_WL)};
  StillAxis axis{};
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 3; ++k) axis.point[i][k] = static_cast<float>(ends[i][k]);
  }
  axis.radius = floatAbove(lss.radius);
  const double relative = kTurns * boundsOfMesh.rotationRounding + kTurned + kToFloat;
  const double far = std::max(ends[0].norm(), ends[1].norm());
  const double ofOrigin = boundsOfMesh.positionRoundingAt(0.0);
  axis.pad = floatAbove(
      (std::max(bounds.positionRoundingA, bounds.positionRoundingB) + ofOrigin + relative * far) *
      kInflation);
  axis.padPerRho =
      floatAbove((boundsOfMesh.positionRoundingAt(1.0) - ofOrigin + relative) * kInflation);
  return axis;
}

}  // namespace foretouch::internal
