// tests/reference/cubic.h: cubics in Bernstein form on [0,1], in doubles.
// Over its span a cubic lies between its least and its largest coefficient, and it has no more
// roots there than its coefficients have changes of sign ([Farouki12]).
#pragma once

#include <array>
#include <cmath>
#include <utility>

namespace foretouch::internal {

using Cubic = std::array<double, 4>;

/// Value at t; adds at most 8 u times the largest |coefficient|.
inline double valueAt(const Cubic& c, double t) {
  const double s = 1.0 - t;
  return s * s * s * c[0] + 3.0 * (s * s * t) * c[1] + 3.0 * (s * t * t) * c[2] + t * t * t * c[3];
}

/// The two halves; each adds at most 3 u times the largest |coefficient|.
inline std::pair<Cubic, Cubic> halve(const Cubic& c) {
  const double a = 0.5 * (c[0] + c[1]), b = 0.5 * (c[1] + c[2]), d = 0.5 * (c[2] + c[3]);
  const double e = 0.5 * (a + b), f = 0.5 * (b + d);
  const double m = 0.5 * (e + f);
  return {{c[0], a, e, m}, {m, f, d, c[3]}};
}

/// The part on [from, to], by blossoming; adds at most 16 u times the largest |coefficient|.
inline Cubic restrictTo(const Cubic& c, double from, double to) {
  const double p = 1.0 - from, q = 1.0 - to;
  const double a0 = p * c[0] + from * c[1], a1 = p * c[1] + from * c[2],
               a2 = p * c[2] + from * c[3];
  const double b0 = q * c[0] + to * c[1], b1 = q * c[1] + to * c[2], b2 = q * c[2] + to * c[3];
  const double aa0 = p * a0 + from * a1, aa1 = p * a1 + from * a2;
  const double bb0 = q * b0 + to * b1, bb1 = q * b1 + to * b2;
  return {p * aa0 + from * aa1, q * aa0 + to * aa1, p * bb0 + from * bb1, q * bb0 + to * bb1};
}

/// 1 or -1 if all coefficients are beyond `bound` on that side, else 0.
inline int strictSign(const Cubic& c, double bound) {
  if (c[0] > bound && c[1] > bound && c[2] > bound && c[3] > bound) return 1;
  return c[0] < -bound && c[1] < -bound && c[2] < -bound && c[3] < -bound ? -1 : 0;
}

/// Whether the coefficients, each known up to `bound`, change sign exactly once for certain.
inline bool hasOneRoot(const Cubic& c, double bound) {
  const double sign = c[0] > bound ? 1.0 : -1.0;
  if (!(sign * c[0] > bound && sign * c[3] < -bound)) return false;
  // Only one pattern of two middle signs has three changes: one certain sign excludes it.
  return sign * c[1] > bound || sign * c[2] < -bound;
}

/// A root in [0,1] of a cubic whose ends have opposite signs; a proposal, not a proof. At most
/// kRootSteps steps of Newton inside a shrinking bracket.
inline constexpr int kRootSteps = 60;
inline double rootOf(const Cubic& c) {
  double low = 0.0, high = 1.0, t = c[0] / (c[0] - c[3]);
  for (int step = 0; step < kRootSteps; ++step) {
    const double s = 1.0 - t;
    const double value = valueAt(c, t);
    if ((value > 0.0) == (c[0] > 0.0)) {
      low = t;
    } else {
      high = t;
    }
    const double slope =
        3.0 * (s * s * (c[1] - c[0]) + 2.0 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
    double next = t - value / slope;
    if (!(next > low && next < high)) {
      if (std::abs(next - t) < 0x1p-52) return t;
      next = 0.5 * (low + high);
    }
    if (std::abs(next - t) < 0x1p-52) return next;
    t = next;
  }
  return t;
}

}  // namespace foretouch::internal
