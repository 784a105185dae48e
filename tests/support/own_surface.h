// tests/support/own_surface.h: which LSS of a link are part of its surface at exact fidelity, told
// by other arithmetic than the product's.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lss/lss.h"

namespace foretouch::test {

inline long double distanceToAxis(const Lss& lss, const Eigen::Vector3d& point) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Vector a = lss.a.cast<long double>(), along = lss.b.cast<long double>() - a;
  const Vector p = point.cast<long double>() - a;
  const long double square = along.squaredNorm();
  const long double s = square > 0 ? std::clamp(p.dot(along) / square, 0.0L, 1.0L) : 0.0L;
  return (p - s * along).norm();
}

/// True: it contains none of its link's triangles wholly, up to the promised 1e-10 m.
inline bool standsForItself(const Lss& lss, const std::vector<Triangle>& triangles) {
  return std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& triangle) {
    const auto& v = triangle.vertices;
    return std::all_of(v.begin(), v.end(), [&](const Eigen::Vector3d& corner) {
      return distanceToAxis(lss, corner) <= lss.radius + 1e-10L;
    });
  });
}

}  // namespace foretouch::test
