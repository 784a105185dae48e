// The stage in integers. Symbols and proofs: tests/reference/linear_query.md 4.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "middleware/exact/scaled_integer.h"
#include "tests/reference/integer_polynomial.h"
#include "tests/reference/moving_polygon.h"

namespace foretouch::internal {
namespace {

using Vector = std::array<Integer, 3>;

/// A corner: from + t * step, with integer components.
struct Corner {
  Vector from, step;
};

struct Corners {
  std::array<Corner, 4> at;
  int count = 0;
};

int lowestExponent(const MovingPolygon& polygon, int axis) {
  int lowest = kNoExponent;
  for (int i = 0; i < polygon.count; ++i) {
    for (const LinearPoint* point : {polygon.plus[i], polygon.minus[i]}) {
      for (const double value : {point->from[axis], point->to[axis]}) {
        lowest = std::min(lowest, exponentOf(value));
      }
    }
  }
  return lowest;
}

/// Each axis has its own power of two: no sign that we need depends on it.
Corners cornersOf(const MovingPolygon& polygon) {
  Corners corners;
  corners.count = polygon.count;
  for (int axis = 0; axis < 3; ++axis) {
    const int lowest = lowestExponent(polygon, axis);
    for (int i = 0; i < polygon.count; ++i) {
      const LinearPoint &p = *polygon.plus[i], &q = *polygon.minus[i];
      Corner& corner = corners.at[i];
      corner.from[axis] = scaled(p.from[axis], lowest) - scaled(q.from[axis], lowest);
      corner.step[axis] =
          scaled(p.to[axis], lowest) - scaled(q.to[axis], lowest) - corner.from[axis];
    }
  }
  return corners;
}

/// Component u x v of a x b.
Polynomial sideOf(const Corner& a, const Corner& b, int u, int v) {
  Polynomial p;
  p.c[0] = a.from[u] * b.from[v] - a.from[v] * b.from[u];
  p.c[1] =
      a.from[u] * b.step[v] - a.from[v] * b.step[u] + a.step[u] * b.from[v] - a.step[v] * b.from[u];
  p.c[2] = a.step[u] * b.step[v] - a.step[v] * b.step[u];
  return p;
}

Polynomial dotOf(const Corner& a, const Corner& b) {
  Polynomial p;
  for (int i = 0; i < 3; ++i) {
    p.c[0] += a.from[i] * b.from[i];
    p.c[1] += a.from[i] * b.step[i] + a.step[i] * b.from[i];
    p.c[2] += a.step[i] * b.step[i];
  }
  return p;
}

class ExactQuery {
 public:
  explicit ExactQuery(const Corners& corners) : corners_(corners) {}

  StageAnswer decide() {
    Polynomial volume;
    if (corners_.count >= 3) volume = volumePolynomial();
    const bool everCoplanar = volume.isZero();
    if ((everCoplanar || volume.c[0] == 0) && inside(Dyadic{})) return {Decision::Yes, 0.0, 0.0};
    if (!everCoplanar) {
      tryRootsOf(volume);
    } else {
      tryEdgesOfCoplanar();
    }
    return best_;
  }

 private:
  int next(int j) const { return j + 1 == corners_.count ? 0 : j + 1; }

  const Polynomial& side(int j, int axis) {
    Polynomial& p = sides_[axis][j];
    if (!known_[axis][j]) {
      p = sideOf(corners_.at[j], corners_.at[next(j)], (axis + 1) % 3, (axis + 2) % 3);
      known_[axis][j] = true;
    }
    return p;
  }

  /// det(corner 0, corner 1, corner 2): zero when the origin is in the polygon's plane.
  Polynomial volumePolynomial() {
    Polynomial volume;
    const Corner& last = corners_.at[2];
    for (int axis = 0; axis < 3; ++axis) {
      const Polynomial& s = side(0, axis);
      volume.c[0] += s.c[0] * last.from[axis];
      volume.c[1] += s.c[1] * last.from[axis] + s.c[0] * last.step[axis];
      volume.c[2] += s.c[2] * last.from[axis] + s.c[1] * last.step[axis];
      volume.c[3] += s.c[2] * last.step[axis];
    }
    return volume;
  }

  /// Whether the polygon contains the origin at an instant when the origin is in its plane.
  template <class Time>
  bool inside(Time&& time) {
    for (int axis = 0; axis < 3; ++axis) {
      bool positive = false, negative = false;
      for (int j = 0; j < corners_.count; ++j) {
        const int sign = signAt(side(j, axis), time);
        positive = positive || sign > 0;
        negative = negative || sign < 0;
      }
      if (positive || negative) return !(positive && negative);
    }
    return insideOfLine(time);
  }

  /// The same when all corners lie on one line through the origin.
  template <class Time>
  bool insideOfLine(Time&& time) {
    for (int i = 0; i < corners_.count; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (signAt(dotOf(corners_.at[i], corners_.at[j]), time) <= 0) return true;
      }
    }
    return false;
  }

  void tryRootsOf(const Polynomial& p) {
    if (p.isZero()) return;
    Roots roots(p);
    for (int i = 0; i < roots.count(); ++i) {
      const StageAnswer bracket = bracketOf(roots[i]);
      if (bracket.toiLow >= best_.toiHigh && best_.decision == Decision::Yes) return;
      if (!inside(roots[i])) continue;
      best_.toiLow = std::min(best_.toiLow, bracket.toiLow);
      best_.toiHigh = std::min(best_.toiHigh, bracket.toiHigh);
      best_.decision = Decision::Yes;
      return;
    }
  }

  static StageAnswer bracketOf(const Root& root) {
    // A dyadic root may need more bits than a double has: then doubles bracket it.
    const int bits = root.low.log2 > 52 ? root.low.log2 - 52 : 0;
    const Integer numerator = root.low.numerator >> bits;
    const int log2 = root.low.log2 - bits;
    const double low = std::ldexp(static_cast<double>(numerator), -log2);
    const bool exact = root.isDyadic && (numerator << bits) == root.low.numerator;
    return {Decision::Yes, low, exact ? low : low + std::ldexp(1.0, -log2)};
  }

  /// The origin never leaves the polygon's plane: contact begins when a side passes the origin, or,
  /// if all corners stay on one line through it, when two corners come to opposite sides.
  void tryEdgesOfCoplanar() {
    best_ = {Decision::No};
    for (int axis = 0; axis < 3; ++axis) {
      bool any = false;
      for (int j = 0; j < corners_.count; ++j) {
        any = any || !side(j, axis).isZero();
        tryRootsOf(side(j, axis));
      }
      if (any) return;
    }
    for (int i = 0; i < corners_.count; ++i) {
      for (int j = 0; j <= i; ++j) tryRootsOf(dotOf(corners_.at[i], corners_.at[j]));
    }
  }

  const Corners& corners_;
  std::array<std::array<Polynomial, 4>, 3> sides_;
  std::array<std::array<bool, 4>, 3> known_{};
  StageAnswer best_{Decision::No};
};

}  // namespace

StageAnswer exactStage(const MovingPolygon& polygon) {
  return ExactQuery(cornersOf(polygon)).decide();
}

}  // namespace foretouch::internal
