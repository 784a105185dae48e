// lss/rounding.h: rounding on the safe side. The one home of the unit roundoffs, of factors that
// cover a few roundings, and of the directed roundings from double to float. Constants of a single
// proof stay in that proof's file, under a name of their own.
#pragma once

#include <cmath>
#include <limits>

namespace foretouch {

/// Unit roundoff of double: an operation errs by at most this share of its result.
inline constexpr double kUnitRoundoff = 0x1p-53;

namespace internal {

/// Unit roundoff of float.
inline constexpr float kUnitRoundoffOfFloat = 0x1p-24F;

/// Covers the rounding of a norm and of a bound's own few operations: 9,000 unit roundoffs of
/// double. Bounds are too large by that much.
inline constexpr double kInflation = 1.0 + 1e-12;

/// Shrinks a computed unit vector so that its true norm is at most 1 (normalising errs by 4 u).
inline constexpr double kUnitShrink = 1.0 - 0x1p-50;

/// Absorbs underflow (m): squares of lengths below about 1e-154 vanish entirely.
inline constexpr double kUnderflow = 1e-150;

/// The largest float not above `x`, and the least float not below it.
[[nodiscard]] inline float floatBelow(double x) {
  const auto nearest = static_cast<float>(x);
  return static_cast<double>(nearest) > x
             ? std::nextafter(nearest, -std::numeric_limits<float>::infinity())
             : nearest;
}
[[nodiscard]] inline float floatAbove(double x) {
  const auto nearest = static_cast<float>(x);
  return static_cast<double>(nearest) < x
             ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
             : nearest;
}

/// Padding: the float nearest to x + |x|*kFloatPadding + kFloatUnderflow is not below x, because
/// the padding is twice the error of rounding to nearest, and more than the least float. The same
/// holds below, with both signs changed. Branch-free, so that vectors do the same. Away from 0 at
/// most two floats above floatAbove(); never 0.
inline constexpr double kFloatPadding = 0x1p-23;
inline constexpr double kFloatUnderflow = 1e-40;  ///< Floats below 1e-38 are 1.4e-45 apart.
[[nodiscard]] inline float floatPaddedAbove(double x) {
  return static_cast<float>(x + (x < 0.0 ? -x : x) * kFloatPadding + kFloatUnderflow);
}

/// The time `step` >= 0 after `t` >= 0, rounded down, because the sum may be half a unit in the
/// last place too large. Returns `end` if the sum, rounded to nearest, is not before it: too late
/// by that half unit at most, in which nothing crosses the floor of proven steps.
[[nodiscard]] inline double timeAfter(double t, double step, double end) {
  const double next = t + step;
  return next >= end ? end : std::nextafter(next, 0.0);
}

}  // namespace internal
}  // namespace foretouch
