// tessellation/lattice.h: points on a cubic lattice, and signs about them that are never wrong. A
// coordinate is a whole number of lattice spacings. Sums of lattice points are exact, so a
// Minkowski sum of two polytopes with corners on the lattice has its corners there too, with no
// rounding to argue about (tessellation/swept_surface.md). Limits: coordinates below
// kMaxLatticeCoordinate, differences that enter products below kMaxLatticeDifference, polytope
// normals below kMaxLatticeNormal; then every sum here fits 127 bits. Not installed.
#pragma once

#include <cstdint>

namespace foretouch {

__extension__ typedef __int128 WideInteger;
__extension__ typedef unsigned __int128 WideUnsigned;

inline constexpr std::int64_t kMaxLatticeCoordinate = std::int64_t{1} << 51;
inline constexpr std::int64_t kMaxLatticeDifference = std::int64_t{1} << 40;
inline constexpr std::int64_t kMaxLatticeNormal = std::int64_t{1} << 61;

struct LatticePoint {
  std::int64_t x = 0, y = 0, z = 0;
};

inline LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline LatticePoint operator-(const LatticePoint& a, const LatticePoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline bool operator==(const LatticePoint& a, const LatticePoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

inline WideInteger exactDot(const LatticePoint& a, const LatticePoint& b) {
  return static_cast<WideInteger>(a.x) * b.x + static_cast<WideInteger>(a.y) * b.y +
         static_cast<WideInteger>(a.z) * b.z;
}

/// u x v. Precondition: components below 2^30, so that the result is below kMaxLatticeNormal.
inline LatticePoint exactCross(const LatticePoint& u, const LatticePoint& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// u . (v x w). Precondition: components below kMaxLatticeDifference.
inline WideInteger exactDeterminant(const LatticePoint& u, const LatticePoint& v,
                                    const LatticePoint& w) {
  const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    return static_cast<WideInteger>(a) * d - static_cast<WideInteger>(b) * c;
  };
  return u.x * minor(v.y, v.z, w.y, w.z) + u.y * minor(v.z, v.x, w.z, w.x) +
         u.z * minor(v.x, v.y, w.x, w.y);
}

/// The sign of a*b - c*d, of which all are >= 0 and below 2^126.
inline int signOfDifferenceOfProducts(WideInteger a, WideInteger b, WideInteger c, WideInteger d) {
  struct Product {
    WideUnsigned high, low;
  };
  const auto product = [](WideInteger first, WideInteger second) {
    const auto p = static_cast<WideUnsigned>(first), q = static_cast<WideUnsigned>(second);
    const WideUnsigned mask = ~std::uint64_t{0};
    const WideUnsigned low = (p & mask) * (q & mask), high = (p >> 64) * (q >> 64);
    const WideUnsigned crossA = (p >> 64) * (q & mask), crossB = (p & mask) * (q >> 64);
    const WideUnsigned middle = (low >> 64) + (crossA & mask) + (crossB & mask);
    return Product{high + (crossA >> 64) + (crossB >> 64) + (middle >> 64),
                   (low & mask) | (middle << 64)};
  };
  const Product left = product(a, b), right = product(c, d);
  if (left.high != right.high) return left.high < right.high ? -1 : 1;
  if (left.low != right.low) return left.low < right.low ? -1 : 1;
  return 0;
}

}  // namespace foretouch
