// judge/vector.h: the judge's own vectors, over any number type: double for a quick look, long
// double for the decision, thirty-four (wide.h) and fifty digits (precise.h) for the remaining
// cases. Plain numbers, so that it shares nothing with the product, not even its matrix library.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace foretouch::oracle {

/// 64 bits of mantissa on x86-64: eleven more than the judged code has.
using Real = long double;

template <typename S>
struct Vec3 {
  S x = 0, y = 0, z = 0;

  Vec3() = default;
  Vec3(S anX, S aY, S aZ) : x(std::move(anX)), y(std::move(aY)), z(std::move(aZ)) {}
  /// From any vector type that has x(), y() and z().
  template <typename Other, typename = decltype(std::declval<const Other&>().z())>
  explicit Vec3(const Other& v) : x(v.x()), y(v.y()), z(v.z()) {}

  template <typename Other>
  [[nodiscard]] Vec3<Other> as() const {
    return {static_cast<Other>(x), static_cast<Other>(y), static_cast<Other>(z)};
  }
  S& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const S& operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool operator==(const Vec3& o) const { return x == o.x && y == o.y && z == o.z; }
};

/// S, without template deduction: a factor may be any number that converts to S.
template <typename S>
struct Same {
  using Type = S;
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
Vec3<S> operator*(const typename Same<S>::Type& s, const Vec3<S>& a) {
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
/// The largest coordinate's magnitude. Rounding is proportional to it.
template <typename S>
S extent(const Vec3<S>& a) {
  using std::abs;
  return std::max({abs(a.x), abs(a.y), abs(a.z)});
}

/// The corners of a triangle.
template <typename S>
using Corners = std::array<Vec3<S>, 3>;

using Vec3d = Vec3<double>;
using Vec3r = Vec3<Real>;
using Triangle = Corners<double>;

template <typename S>
Corners<S> cornersOf(const Triangle& triangle, const Vec3d& origin = {}) {
  const Vec3<S> from = origin.as<S>();
  return {triangle[0].as<S>() - from, triangle[1].as<S>() - from, triangle[2].as<S>() - from};
}

}  // namespace foretouch::oracle
