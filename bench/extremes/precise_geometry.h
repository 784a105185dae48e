// bench/extremes/precise_geometry.h: vectors, quaternions and distances over any real number
// type; what the oracle of `bench extremes` computes with. Textbook formulas, slow on purpose,
// nothing of the product in them. (tests/support/precise.h is the tests' own; tools do not see
// tests.)
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace foretouch::tools::extremes {

using Precise = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                              boost::multiprecision::et_off>;
using VeryPrecise = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
                                                  boost::multiprecision::et_off>;

template <typename Real>
struct Vector {
  Real x = 0, y = 0, z = 0;
};

template <typename Real>
Vector<Real> operator+(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename Real>
Vector<Real> operator-(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename Real>
Vector<Real> operator*(const Real& s, const Vector<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <typename Real>
Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Real>
Vector<Real> cross(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename Real>
Real norm(const Vector<Real>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

template <typename Real>
struct Rotation {  // unit quaternion
  Real w = 1, x = 0, y = 0, z = 0;
};
template <typename Real>
Rotation<Real> operator*(const Rotation<Real>& a, const Rotation<Real>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <typename Real>
Vector<Real> rotate(const Rotation<Real>& q, const Vector<Real>& v) {
  const Vector<Real> u{q.x, q.y, q.z};
  const Vector<Real> twice = Real(2) * cross(u, v);
  return v + q.w * twice + cross(u, twice);
}

/// The nearest points found so far, of two sets. Every pair offered lies in the sets, so `square`
/// never is below the true least but for rounding.
template <typename Real>
struct Nearest {
  Vector<Real> onOne, onOther;
  Real square = -1;  // none yet
  void offer(const Vector<Real>& one, const Vector<Real>& other) {
    const Vector<Real> d = one - other;
    const Real s = dot(d, d);
    if (square < 0 || s < square) *this = Nearest{one, other, s};
  }
};

template <typename Real>
using Corners = std::array<Vector<Real>, 3>;

/// The point of the segment from `c` by `v` nearest to `p`.
template <typename Real>
Vector<Real> footOnSegment(const Vector<Real>& p, const Vector<Real>& c, const Vector<Real>& v) {
  const Real vv = dot(v, v);
  if (!(vv > 0)) return c;
  const Real s = dot(p - c, v) / vv;
  if (s <= 0) return c;
  if (s >= 1) return c + v;
  return c + s * v;
}

template <typename Real>
void offerSegments(const Vector<Real>& a, const Vector<Real>& u, const Vector<Real>& c,
                   const Vector<Real>& v, Nearest<Real>& best) {
  best.offer(a, footOnSegment(a, c, v));
  best.offer(a + u, footOnSegment(Vector<Real>(a + u), c, v));
  best.offer(footOnSegment(c, a, u), c);
  best.offer(footOnSegment(Vector<Real>(c + v), a, u), c + v);
  const Vector<Real> n = cross(u, v);
  const Real nn = dot(n, n);
  if (!(nn > 0)) return;
  const Real s = dot(cross(c - a, v), n) / nn, t = dot(cross(c - a, u), n) / nn;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best.offer(a + s * u, c + t * v);
}

/// Pairs `p` with its foot on the triangle's face, if that lies inside. `one` says which side of
/// the answer p belongs to.
template <typename Real>
void offerFace(const Vector<Real>& p, const Corners<Real>& v, bool isOne, Nearest<Real>& best) {
  const Vector<Real> n = cross(v[1] - v[0], v[2] - v[0]);
  const Real nn = dot(n, n);
  if (!(nn > 0)) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(v[(i + 1) % 3] - v[i], p - v[i]), n) < 0) return;
  }
  const Vector<Real> foot = p - Real(dot(p - v[0], n) / nn) * n;
  if (isOne) {
    best.offer(p, foot);
  } else {
    best.offer(foot, p);
  }
}

/// The segment from `a` to `b` against the face: its ends, and where it crosses the plane.
template <typename Real>
void offerSegmentAndFace(const Vector<Real>& a, const Vector<Real>& b, const Corners<Real>& v,
                         bool isOne, Nearest<Real>& best) {
  offerFace(a, v, isOne, best);
  offerFace(b, v, isOne, best);
  const Vector<Real> n = cross(v[1] - v[0], v[2] - v[0]);
  const Real ha = dot(a - v[0], n), hb = dot(b - v[0], n);
  const bool crosses = (ha <= 0 && hb >= 0) || (ha >= 0 && hb <= 0);
  if (crosses && ha != hb)
    offerFace(Vector<Real>(a + Real(ha / (ha - hb)) * (b - a)), v, isOne, best);
}

/// The hull of two or three points (`count`) against a triangle, degenerate ones included: two
/// convex sets are nearest, or meet, on an edge of one of them.
template <typename Real>
Nearest<Real> nearestPoints(const Corners<Real>& hull, int count, const Corners<Real>& triangle) {
  Nearest<Real> best;
  const int edges = count == 2 ? 1 : 3;
  for (int i = 0; i < edges; ++i) {
    const Vector<Real>& a = hull[static_cast<std::size_t>(i)];
    const Vector<Real>& b = hull[static_cast<std::size_t>((i + 1) % count)];
    offerSegmentAndFace(a, b, triangle, true, best);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector<Real>& c = triangle[k];
      offerSegments(a, Vector<Real>(b - a), c, Vector<Real>(triangle[(k + 1) % 3] - c), best);
    }
  }
  if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      offerSegmentAndFace(triangle[k], triangle[(k + 1) % 3], hull, false, best);
    }
  }
  return best;
}

}  // namespace foretouch::tools::extremes
