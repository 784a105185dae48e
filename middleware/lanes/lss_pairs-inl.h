// middleware/lanes/lss_pairs-inl.h: the kernels of lss_pairs.cpp and near_triangles.cpp, compiled
// once per vector width.
// Nothing in here may be shared with other sources (no Eigen, no standard templates): a function
// compiled for wide vectors must not be linked into code for all processors.
#if defined(FORETOUCH_LANES_LSS_PAIRS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_LANES_LSS_PAIRS_INL_H
#undef FORETOUCH_LANES_LSS_PAIRS_INL_H
#else
#define FORETOUCH_LANES_LSS_PAIRS_INL_H
#endif

#include <hwy/highway.h>

#include "lss/rounding.h"
#include "middleware/lanes/lss_pairs.h"
#include "middleware/lanes/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Shrinks a computed unit vector, whose norm errs by at most 5 u, to a true norm of at most 1.
constexpr float kUnitShrinkOfFloat = 1.0f - 8.0f * kUnitRoundoffOfFloat;
/// Past the rounding of a step's formula: at most ten roundings of terms of one sign.
constexpr float kStepShrinkOfFloat = 1.0f - 16.0f * kUnitRoundoffOfFloat;
/// Past the rounding of time + step, both at most 2: half a unit in the last place of 2, doubled.
constexpr float kTimeRounding = 0x1p-22f;
/// Keeps divisors away from zero if a feature has no extent; they only propose.
constexpr float kTiny = 1e-30f;
/// A distance of closest points below this share of the squared extent (a length; extents are of
/// the order of metres) has so noisy a direction that the kernel also tries the features' own
/// normal.
constexpr float kNoisyDistance = 0.1f;

/// 1/x, x > 0, for proposals. By division: processors' approximate reciprocals differ from maker to
/// maker, and what is proposed decides the last places of answers.
template <class V>
HWY_INLINE V inverseOf(V x) {
  return hn::Div(hn::Set(hn::DFromV<V>(), 1.0f), x);
}
/// Point and derivative of one axis end at the lanes' times.
template <class V>
struct Moving {
  Point<V> position, velocity;
};
template <class V>
HWY_INLINE void evaluate(const float (&c)[8], V u, V& position, V& velocity) {
  const hn::DFromV<V> d;
  V p = hn::Set(d, c[7]), v = hn::Set(d, c[7]);
  p = hn::MulAdd(p, u, hn::Set(d, c[6]));
  for (int k = 5; k >= 0; --k) {
    v = hn::MulAdd(v, u, p);
    p = hn::MulAdd(p, u, hn::Set(d, c[k]));
  }
  position = p;
  velocity = v;
}
template <class V>
HWY_INLINE Moving<V> endAt(const float (&c)[3][8], V u) {
  Moving<V> end;
  evaluate(c[0], u, end.position.x, end.velocity.x);
  evaluate(c[1], u, end.position.y, end.velocity.y);
  evaluate(c[2], u, end.position.z, end.velocity.z);
  return end;
}

/// Packs the chosen lanes, in order. Like hn::Compress, but finds the permutation once for all rows
/// and needs no tables, which GCC 12 copies to the stack on every call.
template <class D>
class Chosen {
 public:
  using Mask = hn::Mask<D>;
  using Signed = hn::RebindToSigned<D>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static constexpr bool kByTable = kLanes == 4 || kLanes == 8;

  HWY_INLINE Chosen(D d, Mask mask) : mask_(mask), count_(hn::CountTrue(d, mask)) {
    if constexpr (kByTable) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, mask, bits);
      const hn::Rebind<std::uint8_t, D> bytes;
      const auto from = hn::PromoteTo(Signed(), hn::LoadU(bytes, kLanesOfBits[bits[0]]));
      hn::StoreU(from, Signed(), from_);
    }
  }
  [[nodiscard]] HWY_INLINE std::size_t count() const { return count_; }

  /// Writes a whole vector.
  template <class V, class T>
  HWY_INLINE void store(V lanes, T* to) const {
    const hn::DFromV<V> d;
    if constexpr (kByTable) {
      const auto from = hn::SetTableIndices(d, from_);
      hn::StoreU(hn::TableLookupLanes(lanes, from), d, to);
    } else {
      hn::StoreU(hn::Compress(lanes, hn::RebindMask(d, mask_)), d, to);
    }
  }

 private:
  Mask mask_;
  std::size_t count_;
  std::int32_t from_[kLanes];
};

/// Triangles relative to the origin; `reach` has their rounding in it.
template <class V>
struct Triangles {
  Point<V> corner[3];
  V reach;
};
/// The triangles of a leaf, from one of them on.
template <class D>
HWY_INLINE Triangles<hn::Vec<D>> trianglesOf(D d, const float* vertices, const float* origin,
                                             float reach) {
  Triangles<hn::Vec<D>> result;
  auto largest = hn::Zero(d);
  for (int corner = 0; corner < 3; ++corner) {
    const float* const from = vertices + 3 * corner * kBvhWidth;
    auto& p = result.corner[corner];
    p.x = hn::Sub(hn::Load(d, from), hn::Set(d, origin[0]));
    p.y = hn::Sub(hn::Load(d, from + kBvhWidth), hn::Set(d, origin[1]));
    p.z = hn::Sub(hn::Load(d, from + 2 * kBvhWidth), hn::Set(d, origin[2]));
    largest = hn::Max(largest, hn::Max(hn::Abs(p.x), hn::Max(hn::Abs(p.y), hn::Abs(p.z))));
  }
  const auto grown = hn::MulAdd(largest, hn::Set(d, kRoundingOfCoordinate), hn::Set(d, reach));
  result.reach = hn::Mul(grown, hn::Set(d, kSumInflation));
  return result;
}
/// The chosen ones, as rows from `row` on.
template <class V, class D>
HWY_INLINE void storeTriangles(const Triangles<V>& triangles, const Chosen<D>& chosen,
                               const LaneRows& rows, std::size_t row) {
  for (int corner = 0; corner < 3; ++corner) {
    float* const* const to = rows.coordinates + 3 * corner;
    chosen.store(triangles.corner[corner].x, to[0] + row);
    chosen.store(triangles.corner[corner].y, to[1] + row);
    chosen.store(triangles.corner[corner].z, to[2] + row);
  }
  chosen.store(triangles.reach, rows.reach + row);
}
/// Rows from `row` on.
template <class D>
HWY_INLINE Triangles<hn::Vec<D>> loadTriangles(D d, const LaneRows& rows, std::size_t row) {
  Triangles<hn::Vec<D>> result;
  for (int corner = 0; corner < 3; ++corner) {
    float* const* const from = rows.coordinates + 3 * corner;
    result.corner[corner] = {hn::Load(d, from[0] + row), hn::Load(d, from[1] + row),
                             hn::Load(d, from[2] + row)};
  }
  result.reach = hn::Load(d, rows.reach + row);
  return result;
}

/// Spheres around clusters, relative to the origin; `reach` has radius and rounding in it.
template <class V>
struct Spheres {
  Point<V> centre;
  V reach;
};
/// The spheres of clusters[which[i]]; lanes from `count` on mean nothing.
template <class D>
HWY_INLINE Spheres<hn::Vec<D>> spheresOf(D d, const Cluster* clusters, const std::int32_t* which,
                                         std::size_t count, const float* origin, float reach) {
  const hn::RebindToSigned<D> di;
  const float* const base = clusters->centre;
  // Lanes beyond the count read the first cluster.
  const auto valid = hn::FirstN(di, count);
  const auto index = hn::ShiftLeft<2>(hn::IfThenElseZero(valid, hn::LoadU(di, which)));
  const Point<hn::Vec<D>> centre{
      hn::Sub(hn::GatherIndex(d, base, index), hn::Set(d, origin[0])),
      hn::Sub(hn::GatherIndex(d, base + 1, index), hn::Set(d, origin[1])),
      hn::Sub(hn::GatherIndex(d, base + 2, index), hn::Set(d, origin[2]))};
  const auto largest = hn::Max(hn::Abs(centre.x), hn::Max(hn::Abs(centre.y), hn::Abs(centre.z)));
  const auto grown =
      hn::MulAdd(hn::GatherIndex(d, base + 3, index), hn::Set(d, kSphereInflation),
                 hn::MulAdd(largest, hn::Set(d, kRoundingOfCoordinate), hn::Set(d, reach)));
  return {centre, hn::Mul(grown, hn::Set(d, kSumInflation))};
}

/// One lane's result of one evaluation.
template <class D>
struct Advance {
  hn::Vec<D> gap;   // proven lower bound of the separation now
  hn::Vec<D> next;  // proven to stay above the floor until then
  hn::Mask<D> handOver, inContact;
};

/// A plane: clearances of both ends above all the other side's points, and the ends' speeds away
/// from it.
template <class V>
struct Plane {
  V gapA, gapB, speedA, speedB;
};

/// Ends, bounds and tolerances, as both kernels use them.
struct EndSteps {
  const LaneLss& lss;
  const LaneTolerances& tolerances;

  /// Largest s with clearance + s*speed - acceleration*s^2/2 >= 0 throughout, rounded down.
  template <class V>
  static HWY_INLINE V safeStep(V clearance, V speed, float acceleration) {
    const hn::DFromV<V> d;
    const V bend = hn::Set(d, acceleration + kTiny);
    const V root =
        hn::Sqrt(hn::MulAdd(speed, speed, hn::Mul(hn::Mul(hn::Set(d, 2.0f), bend), clearance)));
    // Two forms of the positive root, each a sum of terms of one sign.
    const auto closing = hn::Le(speed, hn::Zero(d));
    const V numerator =
        hn::IfThenElse(closing, hn::Add(clearance, clearance), hn::Add(speed, root));
    const V denominator = hn::IfThenElse(closing, hn::Sub(root, speed), bend);
    return hn::Mul(hn::Set(d, kStepShrinkOfFloat), hn::Div(numerator, denominator));
  }

  template <class V>
  HWY_INLINE Advance<hn::DFromV<V>> from(const Plane<V>& plane, V time) const {
    const hn::DFromV<V> d;
    Advance<hn::DFromV<V>> result;
    result.gap = hn::Min(plane.gapA, plane.gapB);
    const V floor = hn::Set(d, tolerances.floor);
    const V slack = hn::Set(d, lss.speedSlack);
    const V step = hn::Min(
        safeStep(hn::Sub(plane.gapA, floor), hn::Sub(plane.speedA, slack), lss.accelerationA),
        safeStep(hn::Sub(plane.gapB, floor), hn::Sub(plane.speedB, slack), lss.accelerationB));
    const V next = hn::Sub(hn::Add(time, step), hn::Set(d, kTimeRounding));
    // Written so that a NaN lane is handed over.
    const auto goesOn =
        hn::And(hn::Gt(result.gap, hn::Set(d, tolerances.handOver)), hn::Gt(next, time));
    result.handOver = hn::Not(goesOn);
    result.next = hn::IfThenElse(goesOn, next, time);
    return result;
  }
};

/// The unit direction of w, never longer than 1.
template <class V>
HWY_INLINE Point<V> direction(const Point<V>& w) {
  const hn::DFromV<V> d;
  const V norm = hn::Sqrt(hn::Max(dot(w, w), hn::Set(d, kTiny)));
  return scaled(hn::Div(hn::Set(d, kUnitShrinkOfFloat), norm), w);
}

/// The closest points found so far: the difference from triangle to axis, and a direction that
/// the features themselves define.
template <class V>
struct Closest {
  V squared;
  Point<V> w, normal;
  HWY_INLINE void offer(V candidate, const Point<V>& difference, const Point<V>& featureNormal) {
    const auto nearer = hn::Lt(candidate, squared);
    squared = hn::Min(candidate, squared);
    w = select(nearer, difference, w);
    normal = select(nearer, featureNormal, normal);
  }
};

/// Closest points of the axis (from p, along d; p relative to the edge's origin) and an edge.
template <class V>
HWY_INLINE void offerEdge(const Point<V>& p, const Point<V>& axis, V squaredAxis, V inverseAxis,
                          const Point<V>& edge, Closest<V>& best) {
  const hn::DFromV<V> d;
  const V tiny = hn::Set(d, kTiny);
  const V squaredEdge = dot(edge, edge), mixed = dot(axis, edge);
  const V onAxis = dot(axis, p), onEdge = dot(edge, p);
  const V determinant = hn::NegMulAdd(mixed, mixed, hn::Mul(squaredAxis, squaredEdge));
  V s = clamp01(hn::Mul(hn::NegMulAdd(onAxis, squaredEdge, hn::Mul(mixed, onEdge)),
                        inverseOf(hn::Max(determinant, tiny))));
  const V t = clamp01(hn::Mul(hn::MulAdd(mixed, s, onEdge), inverseOf(hn::Max(squaredEdge, tiny))));
  s = clamp01(hn::Mul(hn::MulSub(mixed, t, onAxis), inverseAxis));
  const Point<V> w = along(along(p, s, axis), hn::Neg(t), edge);
  best.offer(dot(w, w), w, cross(axis, edge));
}

/// The end p (relative to the face's origin) above the face's interior.
template <class V>
HWY_INLINE void offerFace(const Point<V>& p, const Point<V>& e1, const Point<V>& e2, V d00, V d01,
                          V d11, V inverse, const Point<V>& normal, Closest<V>& best) {
  const hn::DFromV<V> d;
  const V d20 = dot(p, e1), d21 = dot(p, e2);
  const V beta = hn::Mul(hn::NegMulAdd(d01, d21, hn::Mul(d11, d20)), inverse);
  const V gamma = hn::Mul(hn::NegMulAdd(d01, d20, hn::Mul(d00, d21)), inverse);
  const V zero = hn::Zero(d);
  const auto inside = hn::And(hn::And(hn::Ge(beta, zero), hn::Ge(gamma, zero)),
                              hn::Le(hn::Add(beta, gamma), hn::Set(d, 1.0f)));
  const Point<V> w = along(along(p, hn::Neg(beta), e1), hn::Neg(gamma), e2);
  best.offer(hn::IfThenElse(inside, dot(w, w), hn::Set(d, 1e30f)), w, normal);
}

/// The plane with direction n just above the triangle: what it proves about both ends.
template <class V>
HWY_INLINE Plane<V> planeAlong(const Point<V>& n, const Moving<V>& a, const Moving<V>& b,
                               const Point<V> (&v)[3], V reach) {
  const V top = hn::Max(dot(n, v[0]), hn::Max(dot(n, v[1]), dot(n, v[2])));
  return {hn::Sub(hn::Sub(dot(n, a.position), top), reach),
          hn::Sub(hn::Sub(dot(n, b.position), top), reach), dot(n, a.velocity), dot(n, b.velocity)};
}

/// The widest plane found between the axis and the triangle, and the square of the distance of the
/// points that proposed it, which are their own.
template <class V>
struct Widest {
  Plane<V> plane;
  V squared;
};
template <class V>
HWY_INLINE Widest<V> widestPlane(const Moving<V>& a, const Moving<V>& b,
                                 const Triangles<V>& triangles) {
  const hn::DFromV<V> d;
  const Point<V>(&v)[3] = triangles.corner;
  const V reach = triangles.reach;
  const Point<V> axis = sub(b.position, a.position);
  const Point<V> e1 = sub(v[1], v[0]), e2 = sub(v[2], v[0]), e3 = sub(v[2], v[1]);
  const Point<V> p = sub(a.position, v[0]), p3 = sub(a.position, v[1]);
  const V squaredAxis = dot(axis, axis);
  const V inverseAxis = inverseOf(hn::Max(squaredAxis, hn::Set(d, kTiny)));
  const Point<V> normal = cross(e1, e2);
  const V d00 = dot(e1, e1), d01 = dot(e1, e2), d11 = dot(e2, e2);
  const V inverse =
      inverseOf(hn::Max(hn::NegMulAdd(d01, d01, hn::Mul(d00, d11)), hn::Set(d, kTiny)));

  Closest<V> best{hn::Set(d, 1e30f), p, normal};
  offerEdge(p, axis, squaredAxis, inverseAxis, e1, best);
  offerEdge(p, axis, squaredAxis, inverseAxis, e2, best);
  offerEdge(p3, axis, squaredAxis, inverseAxis, e3, best);
  offerFace(p, e1, e2, d00, d01, d11, inverse, normal, best);
  offerFace(sub(b.position, v[0]), e1, e2, d00, d01, d11, inverse, normal, best);

  Plane<V> plane = planeAlong(direction(best.w), a, b, v, reach);
  // For long features that are near, the difference of the closest points is a noisy direction.
  const V extent = hn::Max(hn::Max(d00, d11), squaredAxis);
  const V noise = hn::Mul(hn::Set(d, kNoisyDistance), extent);
  const auto isSteady = hn::Gt(best.squared, hn::Mul(noise, noise));
  if (!hn::AllTrue(d, isSteady)) {
    const auto away = hn::Ge(dot(best.normal, best.w), hn::Zero(d));
    const Point<V> negative = scaled(hn::Set(d, -1.0f), best.normal);
    const Plane<V> other =
        planeAlong(direction(select(away, best.normal, negative)), a, b, v, reach);
    const auto wider = hn::Gt(hn::Min(other.gapA, other.gapB), hn::Min(plane.gapA, plane.gapB));
    // Only in lanes that need it: a pair's result must not depend on its neighbours, whose order
    // depends on the culler.
    const auto better = hn::AndNot(isSteady, wider);
    plane = {hn::IfThenElse(better, other.gapA, plane.gapA),
             hn::IfThenElse(better, other.gapB, plane.gapB),
             hn::IfThenElse(better, other.speedA, plane.speedA),
             hn::IfThenElse(better, other.speedB, plane.speedB)};
  }
  return {plane, best.squared};
}

struct TriangleKernel {
  const LaneLss& lss;
  const LaneTolerances& tolerances;

  template <class D>
  HWY_INLINE Advance<D> operator()(D d, const LaneRows& rows, std::size_t i,
                                   hn::Vec<D> time) const {
    using V = hn::Vec<D>;
    const Moving<V> a = endAt(lss.a, time), b = endAt(lss.b, time);
    const Triangles<V> triangles = loadTriangles(d, rows, i);
    const Widest<V> widest = widestPlane(a, b, triangles);
    Advance<D> result = EndSteps{lss, tolerances}.from(widest.plane, time);
    // Both points belong to their sets, so their distance bounds the separation from above.
    const V spread = hn::MulAdd(hn::Set(d, 3.0f), triangles.reach, hn::Sqrt(widest.squared));
    const V upper = hn::MulSub(hn::Set(d, 1.0f + 0x1p-20f), spread, hn::Set(d, lss.contactShift));
    result.inContact = hn::And(result.handOver, hn::Le(upper, hn::Set(d, tolerances.contact)));
    return result;
  }

  template <class D>
  HWY_INLINE void keep(D d, const LaneRows& rows, std::size_t from, std::size_t to,
                       const Chosen<D>& staying) const {
    for (int k = 0; k < 9; ++k) {
      staying.store(hn::Load(d, rows.coordinates[k] + from), rows.coordinates[k] + to);
    }
    staying.store(hn::Load(d, rows.reach + from), rows.reach + to);
  }
};

/// A plane between the axis and a sphere, whose radius is part of its reach.
template <class V>
struct SpherePlane {
  Point<V> n;
  Plane<V> plane;
};
template <class V>
HWY_INLINE SpherePlane<V> planeAbove(const Moving<V>& a, const Moving<V>& b,
                                     const Spheres<V>& spheres) {
  const hn::DFromV<V> d;
  const Point<V> axis = sub(b.position, a.position), p = sub(a.position, spheres.centre);
  const V s = clamp01(
      hn::Neg(hn::Mul(dot(axis, p), inverseOf(hn::Max(dot(axis, axis), hn::Set(d, kTiny))))));
  const Point<V> n = direction(along(p, s, axis));
  const V top = dot(n, spheres.centre);
  return {n,
          {hn::Sub(hn::Sub(dot(n, a.position), top), spheres.reach),
           hn::Sub(hn::Sub(dot(n, b.position), top), spheres.reach), dot(n, a.velocity),
           dot(n, b.velocity)}};
}

/// The axis against the sphere around a cluster: coordinates 0 to 2 are its centre.
struct SphereKernel {
  const LaneLss& lss;
  const LaneTolerances& tolerances;

  template <class D>
  HWY_INLINE Advance<D> operator()(D d, const LaneRows& rows, std::size_t i,
                                   hn::Vec<D> time) const {
    using V = hn::Vec<D>;
    const Moving<V> a = endAt(lss.a, time), b = endAt(lss.b, time);
    const Spheres<V> spheres{
        {hn::Load(d, rows.coordinates[0] + i), hn::Load(d, rows.coordinates[1] + i),
         hn::Load(d, rows.coordinates[2] + i)},
        hn::Load(d, rows.reach + i)};
    const Plane<V> plane = planeAbove(a, b, spheres).plane;
    Advance<D> result = EndSteps{lss, tolerances}.from(plane, time);
    result.inContact = hn::FirstN(d, 0);
    return result;
  }

  template <class D>
  HWY_INLINE void keep(D d, const LaneRows& rows, std::size_t from, std::size_t to,
                       const Chosen<D>& staying) const {
    for (int k = 0; k < 3; ++k) {
      staying.store(hn::Load(d, rows.coordinates[k] + from), rows.coordinates[k] + to);
    }
    staying.store(hn::Load(d, rows.reach + from), rows.reach + to);
  }
};

/// Reads the pairs, steps each, and keeps those that go on in place. A round is one evaluation of
/// every remaining pair.
template <class D, class Kernel>
std::uint64_t advanceAll(D d, const Kernel& kernel, int maxRounds, const LaneRows& rows,
                         std::size_t count, float& best, const HandedRows& handed,
                         std::size_t& handedCount) {
  const hn::RebindToSigned<D> di;
  const std::size_t lanes = hn::Lanes(d);
  const auto end = hn::Set(d, 1.0f);
  std::uint64_t evaluations = 0;
  for (int round = 1; count > 0; ++round) {
    std::size_t kept = 0;
    evaluations += count;
    for (std::size_t i = 0; i < count; i += lanes) {
      const auto valid = hn::FirstN(d, count - i);
      const auto time = hn::Load(d, rows.time + i);
      const auto key = hn::Load(di, rows.key + i);
      const Advance<D> step = kernel(d, rows, i, time);
      const auto sure = hn::And(valid, step.inContact);
      if (!hn::AllFalse(d, sure)) {
        const auto times = hn::MinOfLanes(d, hn::IfThenElse(sure, time, end));
        const float earliest = hn::GetLane(times);
        if (earliest < best) best = earliest;
      }
      // Done, or later than the first contact. Equal times stay.
      const auto over = hn::Or(hn::Gt(step.next, hn::Set(d, best)), hn::Ge(step.next, end));
      const auto left = hn::AndNot(over, valid);
      const auto hand = round == maxRounds ? left : hn::And(left, step.handOver);
      const auto goesOn = hn::AndNot(hand, left);
      if (!hn::AllFalse(d, hand)) {
        const auto gap = hn::IfThenElse(step.handOver, step.gap, hn::Zero(d));
        const Chosen<D> leaving(d, hand);
        leaving.store(step.next, handed.time + handedCount);
        leaving.store(gap, handed.gap + handedCount);
        leaving.store(key, handed.key + handedCount);
        handedCount += leaving.count();
      }
      const std::size_t going = hn::CountTrue(d, goesOn);
      if (going == lanes && kept == i) {
        hn::Store(step.next, d, rows.time + i);
      } else if (going != 0) {
        const Chosen<D> staying(d, goesOn);
        kernel.keep(d, rows, i, kept, staying);
        staying.store(step.next, rows.time + kept);
        staying.store(key, rows.key + kept);
      }
      kept += going;
    }
    count = kept;
  }
  return evaluations;
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
