// judge/plain_distance.cpp: every pair of features whose feet lie inside.
#include "judge/plain_distance.h"

namespace foretouch::oracle {
namespace {

/// The point of the segment from `c` by `v` nearest to `p`.
template <typename S>
Vec3<S> footOnSegment(const Vec3<S>& p, const Vec3<S>& c, const Vec3<S>& v) {
  const S vv = dot(v, v);
  if (!(vv > 0)) return c;
  const S s = dot(p - c, v) / vv;
  if (s <= 0) return c;
  if (s >= 1) return c + v;
  return c + s * v;
}

template <typename S>
void offerSegments(const Vec3<S>& a, const Vec3<S>& u, const Vec3<S>& c, const Vec3<S>& v,
                   Nearest<S>& best) {
  best.offer(a, footOnSegment(a, c, v));
  best.offer(a + u, footOnSegment(a + u, c, v));
  best.offer(footOnSegment(c, a, u), c);
  best.offer(footOnSegment(c + v, a, u), c + v);
  const Vec3<S> n = cross(u, v);
  const S nn = dot(n, n);
  if (!(nn > 0)) return;
  const S s = dot(cross(c - a, v), n) / nn, t = dot(cross(c - a, u), n) / nn;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best.offer(a + s * u, c + t * v);
}

/// Is p, seen along the triangle's normal n, over the face?
template <typename S>
bool isOver(const Vec3<S>& p, const Corners<S>& v, const Vec3<S>& n) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(v[(i + 1) % 3] - v[i], p - v[i]), n) < 0) return false;
  }
  return true;
}

/// The segment from `a` to `b` against the face: its ends, and where it crosses the plane, which is
/// a point of both. `isOne` says which side of the answer the segment belongs to.
template <typename S>
void offerSegmentAndFace(const Vec3<S>& a, const Vec3<S>& b, const Corners<S>& v, bool isOne,
                         Nearest<S>& best) {
  const Vec3<S> n = cross(v[1] - v[0], v[2] - v[0]);
  const S nn = dot(n, n);
  if (!(nn > 0)) return;
  for (const Vec3<S>& p : {a, b}) {
    if (!isOver(p, v, n)) continue;
    const Vec3<S> foot = p - (dot(p - v[0], n) / nn) * n;
    best.offer(isOne ? p : foot, isOne ? foot : p);
  }
  const S ha = dot(a - v[0], n), hb = dot(b - v[0], n);
  const bool crosses = (ha <= 0 && hb >= 0) || (ha >= 0 && hb <= 0);
  if (!crosses || ha == hb) return;
  const Vec3<S> p = a + (ha / (ha - hb)) * (b - a);
  if (isOver(p, v, n)) best.offer(p, p);
}

}  // namespace

template <typename S>
Nearest<S> nearestPoints(const Corners<S>& hull, int count, const Corners<S>& triangle) {
  Nearest<S> best;
  const int edges = count == 2 ? 1 : 3;
  for (int i = 0; i < edges; ++i) {
    const Vec3<S>& a = hull[static_cast<std::size_t>(i)];
    const Vec3<S>& b = hull[static_cast<std::size_t>((i + 1) % count)];
    offerSegmentAndFace(a, b, triangle, true, best);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<S>& c = triangle[k];
      offerSegments(a, b - a, c, triangle[(k + 1) % 3] - c, best);
    }
  }
  if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      offerSegmentAndFace(triangle[k], triangle[(k + 1) % 3], hull, false, best);
    }
  }
  return best;
}

template Nearest<Precise> nearestPoints(const Corners<Precise>&, int, const Corners<Precise>&);
template Nearest<VeryPrecise> nearestPoints(const Corners<VeryPrecise>&, int,
                                            const Corners<VeryPrecise>&);

Precise preciseDistance(const Vec3<Precise>& a, const Vec3<Precise>& b, const Corners<Precise>& v) {
  return sqrt(nearestPoints<Precise>({a, b, b}, 2, v).square);
}

Precise preciseDistance(const Corners<Precise>& one, const Corners<Precise>& other) {
  return sqrt(nearestPoints(one, 3, other).square);
}

}  // namespace foretouch::oracle
