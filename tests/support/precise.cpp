#include "tests/support/precise.h"

#include <algorithm>

namespace foretouch::test {

Precise3 operator+(const Precise3& a, const Precise3& b) {
  return {a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]};
}
Precise3 operator-(const Precise3& a, const Precise3& b) {
  return {a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]};
}
Precise3 operator*(const Real& s, const Precise3& a) {
  return {s * a.c[0], s * a.c[1], s * a.c[2]};
}
Real dot(const Precise3& a, const Precise3& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2];
}
Precise3 cross(const Precise3& a, const Precise3& b) {
  return {a.c[1] * b.c[2] - a.c[2] * b.c[1], a.c[2] * b.c[0] - a.c[0] * b.c[2],
          a.c[0] * b.c[1] - a.c[1] * b.c[0]};
}
Real norm(const Precise3& a) {
  return sqrt(dot(a, a));
}

PreciseQuaternion operator*(const PreciseQuaternion& a, const PreciseQuaternion& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Precise3 rotate(const PreciseQuaternion& q, const Precise3& v) {
  const PreciseQuaternion p =
      q * PreciseQuaternion{0, v.c[0], v.c[1], v.c[2]} * PreciseQuaternion{q.w, -q.x, -q.y, -q.z};
  return {p.x, p.y, p.z};
}

PreciseQuaternion slerp(const Eigen::Quaternion<double, Eigen::DontAlign>& from,
                        const Eigen::Quaternion<double, Eigen::DontAlign>& to, const Real& t) {
  const double asDoubles =
      from.w() * to.w() + from.x() * to.x() + from.y() * to.y() + from.z() * to.z();
  std::array<Real, 4> p{from.w(), from.x(), from.y(), from.z()};
  std::array<Real, 4> q{to.w(), to.x(), to.y(), to.z()};
  const auto normalise = [](std::array<Real, 4>& x) {
    const Real n = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
    for (Real& e : x) e /= n;
  };
  normalise(p);
  normalise(q);
  if (asDoubles < 0) {
    for (Real& e : q) e = -e;
  }
  // The half angle between them from chord lengths, accurate near 0 and near pi/2 alike.
  Real minus = 0, plus = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    minus += (q[i] - p[i]) * (q[i] - p[i]);
    plus += (q[i] + p[i]) * (q[i] + p[i]);
  }
  const Real angle = 2 * atan2(sqrt(minus), sqrt(plus));
  Real wp = 1 - t, wq = t;
  if (angle > Real("1e-22")) {
    wp = sin((1 - t) * angle) / sin(angle);
    wq = sin(t * angle) / sin(angle);
  }
  std::array<Real, 4> r;
  for (std::size_t i = 0; i < 4; ++i) r[i] = wp * p[i] + wq * q[i];
  normalise(r);
  return {r[0], r[1], r[2], r[3]};
}

std::vector<PreciseFrame> preciseFrames(const std::vector<PreciseJoint>& joints, const Real& t) {
  std::vector<PreciseFrame> frames;
  for (const PreciseJoint& joint : joints) {
    const PreciseFrame parent =
        joint.parent < 0 ? PreciseFrame{} : frames[static_cast<std::size_t>(joint.parent)];
    const Precise3 from(joint.fromTranslation), to(joint.toTranslation);
    PreciseFrame frame;
    frame.origin = parent.origin + rotate(parent.rotation, from + t * (to - from));
    frame.rotation = parent.rotation * slerp(joint.fromRotation, joint.toRotation, t);
    frames.push_back(frame);
  }
  return frames;
}

namespace {

/// Least squared distance of point p to the segment from c along v.
Real pointSegment2(const Precise3& p, const Precise3& c, const Precise3& v) {
  const Real vv = dot(v, v);
  Real s = vv > 0 ? Real(dot(p - c, v) / vv) : Real(0);
  if (s < 0) s = 0;
  if (s > 1) s = 1;
  const Precise3 d = p - c - s * v;
  return dot(d, d);
}

Real segmentSegment2(const Precise3& a, const Precise3& u, const Precise3& c, const Precise3& v) {
  Real best = pointSegment2(a, c, v);
  for (const Real& d2 :
       {pointSegment2(a + u, c, v), pointSegment2(c, a, u), pointSegment2(c + v, a, u)}) {
    if (d2 < best) best = d2;
  }
  const Precise3 n = cross(u, v);
  const Real nn = dot(n, n);
  if (nn > 0) {
    const Real s = dot(cross(c - a, v), n) / nn, t = dot(cross(c - a, u), n) / nn;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      const Real h = dot(c - a, n);
      if (h * h / nn < best) best = h * h / nn;
    }
  }
  return best;
}

/// Squared distance of p to the plane of the triangle if the foot lies inside it, else -1.
Real faceFoot2(const Precise3& p, const std::array<Precise3, 3>& v, const Precise3& n) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(v[(i + 1) % 3] - v[i], p - v[i]), n) < 0) return -1;
  }
  const Real h = dot(p - v[0], n);
  return h * h / dot(n, n);
}

}  // namespace

Real preciseDistance(const Precise3& a, const Precise3& b, const std::array<Precise3, 3>& v) {
  const Precise3 u = b - a;
  Real best = segmentSegment2(a, u, v[0], v[1] - v[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    const Real d2 = segmentSegment2(a, u, v[i], v[(i + 1) % 3] - v[i]);
    if (d2 < best) best = d2;
  }
  const Precise3 n = cross(v[1] - v[0], v[2] - v[0]);
  if (dot(n, n) > 0) {
    const Real ha = dot(a - v[0], n), hb = dot(b - v[0], n);
    if (ha != hb && ((ha <= 0 && hb >= 0) || (ha >= 0 && hb <= 0)) &&
        faceFoot2(a + Real(ha / (ha - hb)) * u, v, n) >= 0) {
      return 0;
    }
    for (const Precise3& p : {a, b}) {
      const Real d2 = faceFoot2(p, v, n);
      if (d2 >= 0 && d2 < best) best = d2;
    }
  }
  return sqrt(best);
}

Real preciseDistance(const std::array<Precise3, 3>& one, const std::array<Precise3, 3>& other) {
  // Two triangles are nearest (or meet) on an edge of one of them.
  Real best = preciseDistance(one[0], one[1], other);
  for (std::size_t i = 0; i < 3; ++i) {
    best = std::min(best, preciseDistance(one[i], one[(i + 1) % 3], other));
    best = std::min(best, preciseDistance(other[i], other[(i + 1) % 3], one));
  }
  return best;
}

}  // namespace foretouch::test
