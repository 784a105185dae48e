// judge/certificate.cpp: double if that is enough, else long double.
#include "judge/certificate.h"

namespace foretouch::oracle {

HullLook hullLook(const MovingPoint* points, std::size_t count, Real halfSpan) {
  HullLook look;
  look.reference = points[0].position.as<double>();
  look.exact.count = look.quick.count = count;
  look.exact.halfSpan = halfSpan;
  look.quick.halfSpan = static_cast<double>(halfSpan);
  for (std::size_t i = 0; i < count; ++i) {
    look.exact.points[i] = points[i].position - look.reference.as<Real>();
    look.quick.points[i] = look.exact.points[i].as<double>();
    look.exact.velocity[i] = points[i].velocity;
    look.quick.velocity[i] = points[i].velocity.as<double>();
    look.exact.bend[i] = points[i].acceleration * halfSpan * halfSpan / 2;
    look.quick.bend[i] = static_cast<double>(look.exact.bend[i]);
    look.exact.stray = std::max(look.exact.stray, points[i].stray(halfSpan));
  }
  look.quick.stray = static_cast<double>(look.exact.stray);
  return look;
}

HullCheck checkHull(const HullLook& look, Real radius, Real guard, const Triangle& triangle,
                    Real& separation) {
  Triangle corners;
  double size = 0;
  for (std::size_t i = 0; i < look.quick.count; ++i) {
    size = std::max(size, extent(look.quick.points[i]));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = triangle[i] - look.reference;
    size = std::max(size, extent(corners[i]));
  }
  const Certificate<double> rough = certify(look.quick, corners);
  const Real margin = kDoubleMargin * (static_cast<Real>(size) + look.exact.stray);
  if (rough.least - margin > radius) return HullCheck::Free;
  const bool surelyApart = rough.distance - margin > radius;
  if (surelyApart && rough.least + margin < radius) return HullCheck::Open;

  const Corners<Real> exact = cornersOf<Real>(triangle, look.reference);
  const Certificate<Real> fine = certify(look.exact, exact);
  separation = fine.distance - radius;
  // Without radius, a pierced hull is the only sign.
  if (separation < -guard || separation <= -radius) return HullCheck::Touching;
  return fine.least - radius > -guard ? HullCheck::Free : HullCheck::Open;
}

}  // namespace foretouch::oracle
