// tests/support/oracle_vector.h: the oracle's own vectors, in double for the quick look and in long
// double for the decision. Plain numbers, so that nothing is shared with the product, not even its
// matrix library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace foretouch::oracle {

/// 64 bits of mantissa on x86-64: eleven more than what is judged.
using Real = long double;

template <typename S>
struct Vec3 {
  S x = 0, y = 0, z = 0;

  template <typename Other>
  [[nodiscard]] Vec3<Other> as() const {
    return {static_cast<Other>(x), static_cast<Other>(y), static_cast<Other>(z)};
  }
};

template <typename S>
Vec3<S> operator+(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename S>
Vec3<S> operator-(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename S>
Vec3<S> operator*(S s, const Vec3<S>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <typename S>
S dot(const Vec3<S>& a, const Vec3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename S>
S norm(const Vec3<S>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}
/// The largest coordinate's magnitude: what rounding is proportional to.
template <typename S>
S extent(const Vec3<S>& a) {
  using std::abs;
  return std::max({abs(a.x), abs(a.y), abs(a.z)});
}

using Vec3d = Vec3<double>;
using Vec3r = Vec3<Real>;
using Triangle = std::array<Vec3d, 3>;

}  // namespace foretouch::oracle
