// verify/interval.h: numbers that are not known exactly, but surely lie between two doubles. Every
// operation rounds outward: whatever the true operands are, the true result is inside.
// Source: successor and predecessor by one multiplication and one sum, Rump, Zimmermann, Boldo and
// Melquiond, "Computing predecessor and successor in rounding to nearest", BIT 49 (2009),
// Algorithm 2. Needs IEEE 754 doubles, rounding to nearest and no contraction (CMakeLists.txt).
#pragma once

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>

namespace verify {

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0,
              "the proofs are about IEEE 754 doubles");

/// At least the next double above the exact result whose nearest double is `x`.
inline double up(double x) {
  constexpr double kPhi = 0x1p-53 * (1.0 + 0x1p-52), kEta = 0x1p-1074;
  return x + (std::abs(x) * kPhi + kEta);
}
inline double down(double x) {
  return -up(-x);
}

struct Interval {
  double lo = 0.0, hi = 0.0;
  Interval() = default;
  Interval(double exactly) : lo(exactly), hi(exactly) {}  // NOLINT: a double is known exactly
  Interval(double least, double most) : lo(least), hi(most) {}
};

inline Interval operator-(const Interval& x) {
  return {-x.hi, -x.lo};
}
inline Interval operator+(const Interval& x, const Interval& y) {
  return {down(x.lo + y.lo), up(x.hi + y.hi)};
}
inline Interval operator-(const Interval& x, const Interval& y) {
  return {down(x.lo - y.hi), up(x.hi - y.lo)};
}
inline Interval operator*(const Interval& x, const Interval& y) {
  const double a = x.lo * y.lo, b = x.lo * y.hi, c = x.hi * y.lo, d = x.hi * y.hi;
  return {down(std::min(std::min(a, b), std::min(c, d))),
          up(std::max(std::max(a, b), std::max(c, d)))};
}
inline Interval square(const Interval& x) {
  const Interval all = x * x;
  if (x.lo > 0.0 || x.hi < 0.0) return all;
  return {0.0, all.hi};
}
/// Divided by what is surely above zero; for any other divisor nothing is known.
inline Interval operator/(const Interval& x, const Interval& y) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!(y.lo > 0.0)) return {-kInfinity, kInfinity};
  const double a = x.lo / y.lo, b = x.lo / y.hi, c = x.hi / y.lo, d = x.hi / y.hi;
  return {down(std::min(std::min(a, b), std::min(c, d))),
          up(std::max(std::max(a, b), std::max(c, d)))};
}
/// The root of what is not below zero, as far as it is not.
inline Interval root(const Interval& x) {
  return {std::max(0.0, down(std::sqrt(std::max(0.0, x.lo)))), up(std::sqrt(std::max(0.0, x.hi)))};
}
/// Both hold.
inline Interval within(const Interval& x, double least, double most) {
  return {std::max(x.lo, least), std::min(x.hi, most)};
}

using Vector = std::array<Interval, 3>;
using Matrix = std::array<Vector, 3>;        ///< Rows.
using Quaternion = std::array<Interval, 4>;  ///< w, x, y, z.

inline Vector operator+(const Vector& x, const Vector& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
inline Vector operator*(const Interval& s, const Vector& v) {
  return {s * v[0], s * v[1], s * v[2]};
}
inline Interval dot(const Vector& x, const Vector& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
inline Interval length(const Vector& v) {
  return root(square(v[0]) + square(v[1]) + square(v[2]));
}
inline Vector operator*(const Matrix& m, const Vector& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  }
  return product;
}

/// Made unit; its norm is surely not zero, or nothing is known of the result.
inline Quaternion unit(const Quaternion& q) {
  const Interval norm = root(square(q[0]) + square(q[1]) + square(q[2]) + square(q[3]));
  Quaternion result;
  for (std::size_t i = 0; i < 4; ++i) result[i] = within(q[i] / norm, -1.0, 1.0);
  return result;
}
/// The rotation of a unit quaternion.
inline Matrix rotation(const Quaternion& q) {
  const auto& [w, x, y, z] = q;
  const Interval one(1.0), two(2.0);
  return {{{one - two * (square(y) + square(z)), two * (x * y - w * z), two * (x * z + w * y)},
           {two * (x * y + w * z), one - two * (square(x) + square(z)), two * (y * z - w * x)},
           {two * (x * z - w * y), two * (y * z + w * x), one - two * (square(x) + square(y))}}};
}

}  // namespace verify
