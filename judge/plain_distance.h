// judge/plain_distance.h: the nearest points of a segment or a triangle and a triangle, by textbook
// formulas (cross products and clamped feet), in enough digits that their cancellation does not
// matter. The reference for distance.h, which must be careful in few digits, and the tests'
// yardstick for rounding. Slow on purpose.
#pragma once

#include "judge/precise.h"
#include "judge/vector.h"

namespace foretouch::oracle {

/// The nearest points found so far, of two sets. Every offered pair lies in the sets, so `square`
/// is never below the true least except by rounding.
template <typename S>
struct Nearest {
  Vec3<S> onOne, onOther;
  S square = -1;  // none yet
  void offer(const Vec3<S>& one, const Vec3<S>& other) {
    const Vec3<S> d = one - other;
    const S s = dot(d, d);
    if (square < 0 || s < square) *this = Nearest{one, other, s};
  }
};

/// The hull of two or three points (`count`) against a triangle, degenerate ones included: two
/// convex sets are nearest, or meet, on an edge of one of them. Instances: Precise, VeryPrecise.
template <typename S>
Nearest<S> nearestPoints(const Corners<S>& hull, int count, const Corners<S>& triangle);

/// Distance of the segment ab and a triangle.
[[nodiscard]] Precise preciseDistance(const Vec3<Precise>& a, const Vec3<Precise>& b,
                                      const Corners<Precise>& v);
/// Distance of two triangles.
[[nodiscard]] Precise preciseDistance(const Corners<Precise>& one, const Corners<Precise>& other);

}  // namespace foretouch::oracle
