// judge/certificate.cpp: double if that is enough, else long double.
#include "judge/certificate.h"

namespace foretouch::oracle {

namespace {

double extentOf(const HullView<double>& hull) {
  double size = 0;
  for (std::size_t i = 0; i < hull.count; ++i) size = std::max(size, extent(hull.points[i]));
  return size;
}

/// `size` is the largest coordinate; exactOther() is `quickOther` in long double.
template <typename Other, typename ExactOther>
HullCheck check(const HullLook& look, Real radius, Real guard, const Other& quickOther, double size,
                const ExactOther& exactOther, Real& separation) {
  const Certificate<double> rough = certify(look.quick, quickOther);
  const Real margin =
      kDoubleMargin * (static_cast<Real>(size) + look.exact.stray + strayOf(quickOther));
  if (rough.least - margin > radius) return HullCheck::Free;
  const bool surelyApart = rough.distance - margin > radius;
  if (surelyApart && rough.least + margin < radius) return HullCheck::Open;

  const Certificate<Real> fine = certify(look.exact, exactOther());
  separation = fine.distance - radius;
  // Without radius, a pierced hull is the only sign.
  if (separation < -guard || separation <= -radius) return HullCheck::Touching;
  return fine.least - radius > -guard ? HullCheck::Free : HullCheck::Open;
}

}  // namespace

HullLook hullLook(const MovingPoint* points, std::size_t count, Real halfSpan) {
  return hullLook(points, count, halfSpan, points[0].position.as<double>());
}

HullLook hullLook(const MovingPoint* points, std::size_t count, Real halfSpan,
                  const Vec3d& reference) {
  HullLook look;
  look.reference = reference;
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
  for (std::size_t i = count; i < 3; ++i) {
    look.exact.points[i] = look.exact.points[count - 1];
    look.quick.points[i] = look.quick.points[count - 1];
  }
  look.quick.stray = static_cast<double>(look.exact.stray);
  return look;
}

HullCheck checkHull(const HullLook& look, Real radius, Real guard, const Triangle& triangle,
                    Real& separation) {
  Triangle corners;
  double size = extentOf(look.quick);
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = triangle[i] - look.reference;
    size = std::max(size, extent(corners[i]));
  }
  const auto exact = [&] { return cornersOf<Real>(triangle, look.reference); };
  return check(look, radius, guard, corners, size, exact, separation);
}

HullCheck checkHull(const HullLook& look, Real radius, Real guard, const HullLook& other,
                    Real& separation) {
  const double size = std::max(extentOf(look.quick), extentOf(other.quick));
  const auto exact = [&]() -> const HullView<Real>& { return other.exact; };
  return check(look, radius, guard, other.quick, size, exact, separation);
}

}  // namespace foretouch::oracle
