#include "tessellation/swept_lss.h"

#include <algorithm>

#include "lss/rounding.h"

namespace foretouch {

using internal::kInflation;

AxisBounds axisBounds(const Lss& lss_L, const MotionBounds& bounds) {
  const double rhoA = lss_L.a.norm() * kInflation, rhoB = lss_L.b.norm() * kInflation;
  AxisBounds result;
  result.accelerationA = bounds.accelerationAt(rhoA) * kInflation;
  result.accelerationB = bounds.accelerationAt(rhoB) * kInflation;
  result.speed = bounds.speedAt(std::max(rhoA, rhoB)) * kInflation;
  result.positionRoundingA = bounds.positionRoundingAt(rhoA) * kInflation;
  result.positionRoundingB = bounds.positionRoundingAt(rhoB) * kInflation;
  result.velocityRoundingA = bounds.velocityRoundingAt(rhoA) * kInflation;
  result.velocityRoundingB = bounds.velocityRoundingAt(rhoB) * kInflation;
  return result;
}

Aabb sweptBox(const Lss& lss_L, const AxisBounds& bounds, const AxisEnds& begin,
              const AxisEnds& end, double span, double margin) {
  const double sagitta = span * span / 8.0;
  Aabb pathA, pathB;
  pathA.add(begin.a);
  pathA.add(end.a);
  pathA.grow((bounds.accelerationA * sagitta + bounds.positionRoundingA + lss_L.radius + margin) *
             kInflation);
  pathB.add(begin.b);
  pathB.add(end.b);
  pathB.grow((bounds.accelerationB * sagitta + bounds.positionRoundingB + lss_L.radius + margin) *
             kInflation);
  pathA.add(pathB);
  return pathA;
}

}  // namespace foretouch
