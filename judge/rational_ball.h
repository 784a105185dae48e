// judge/rational_ball.h: a number known to lie within `radius` of `center`. Every operation adds
// its own rounding, so any sign that a ball decides is true.
#pragma once

#include <cmath>

namespace foretouch::oracle {

struct Ball {
  long double center = 0, radius = 0;

  Ball() = default;
  Ball(double exact) : center(exact) {}  // NOLINT: implicit by intent
  Ball(long double c, long double r) : center(c), radius(r) {}

  [[nodiscard]] bool isPositive() const { return center > radius; }
  [[nodiscard]] bool isNegative() const { return center < -radius; }
};

/// A rounding is at most 2^-64 of the result (x86-64's long double); twice that also covers the
/// radius's own few roundings when the operands' radii are zero; kBallGrowth covers the other
/// cases.
inline constexpr long double kBallRounding = 0x1p-63L, kBallGrowth = 1 + 0x1p-60L;

inline Ball operator+(const Ball& a, const Ball& b) {
  const long double sum = a.center + b.center;
  return {sum, (a.radius + b.radius + kBallRounding * std::fabs(sum)) * kBallGrowth};
}
inline Ball operator-(const Ball& a, const Ball& b) {
  const long double difference = a.center - b.center;
  return {difference, (a.radius + b.radius + kBallRounding * std::fabs(difference)) * kBallGrowth};
}
inline Ball operator*(const Ball& a, const Ball& b) {
  const long double product = a.center * b.center;
  return {product, (std::fabs(a.center) * b.radius + (std::fabs(b.center) + b.radius) * a.radius +
                    kBallRounding * std::fabs(product)) *
                       kBallGrowth};
}
/// Exact: a power of two.
inline Ball half(const Ball& a) {
  return {a.center / 2, a.radius / 2};
}

}  // namespace foretouch::oracle
