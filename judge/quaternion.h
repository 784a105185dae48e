// judge/quaternion.h: turns, over any number type.
#pragma once

#include "judge/vector.h"

namespace foretouch::oracle {

template <typename S>
struct Quaternion {
  S w = 1, x = 0, y = 0, z = 0;

  [[nodiscard]] Vec3<S> vector() const { return {x, y, z}; }
};

template <typename S>
Quaternion<S> quaternion(const S& w, const Vec3<S>& v) {
  return {w, v.x, v.y, v.z};
}
template <typename S>
Quaternion<S> quaternionOf(const std::array<double, 4>& wxyz) {
  return {S(wxyz[0]), S(wxyz[1]), S(wxyz[2]), S(wxyz[3])};
}
template <typename S>
Quaternion<S> conjugate(const Quaternion<S>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
template <typename S>
Quaternion<S> operator*(const Quaternion<S>& a, const Quaternion<S>& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
template <typename S>
S dot(const Quaternion<S>& a, const Quaternion<S>& b) {
  return a.w * b.w + dot(a.vector(), b.vector());
}
template <typename S>
S norm(const Quaternion<S>& q) {
  using std::sqrt;
  return sqrt(dot(q, q));
}
template <typename S>
Quaternion<S> unit(const Quaternion<S>& q) {
  const S length = norm(q);
  return {q.w / length, q.x / length, q.y / length, q.z / length};
}

/// By a unit quaternion.
template <typename S>
Vec3<S> rotate(const Quaternion<S>& q, const Vec3<S>& v) {
  const Vec3<S> twice = S(2) * cross(q.vector(), v);
  return v + q.w * twice + cross(q.vector(), twice);
}
/// |q|^2 R(q) v = q (0, v) q*, for any quaternion.
template <typename S>
Vec3<S> rotateAndScale(const Quaternion<S>& q, const Vec3<S>& v) {
  const Vec3<S> twice = S(2) * cross(q.vector(), v);
  return dot(q, q) * v + q.w * twice + cross(q.vector(), twice);
}

}  // namespace foretouch::oracle
