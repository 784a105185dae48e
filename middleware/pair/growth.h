// middleware/pair/growth.h: a length that is added to the radii of a pair, or taken off them, and
// that changes while the two move. Metres; t in [0,1] of the motion at hand. Not installed.
#pragma once

#include <algorithm>

namespace foretouch::internal {

/// constant + t * (linear + t * square); at least 0 on [0,1].
struct Growth {
  double constant = 0.0, linear = 0.0, square = 0.0;

  [[nodiscard]] double at(double t) const { return constant + t * (linear + t * square); }
  [[nodiscard]] double rateAt(double t) const { return linear + 2.0 * t * square; }
  [[nodiscard]] double bend() const { return 2.0 * square; }
  /// The most on [from, to].
  [[nodiscard]] double mostIn(double from, double to) const {
    const double atEnds = std::max(at(from), at(to));
    const double top = square < 0.0 ? -0.5 * linear / square : from;
    return top > from && top < to ? std::max(atEnds, at(top)) : atEnds;
  }
  /// The most on [0,1].
  [[nodiscard]] double most() const { return mostIn(0.0, 1.0); }
};
[[nodiscard]] inline Growth operator+(const Growth& x, const Growth& y) {
  return {x.constant + y.constant, x.linear + y.linear, x.square + y.square};
}

}  // namespace foretouch::internal
