// The stage in doubles. Symbols, bounds and why each step is sound:
// tests/reference/linear_query.md.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tests/reference/cubic.h"
#include "tests/reference/filter_corners.h"
#include "tests/reference/moving_polygon.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// Absorbs underflow of products of two or three lengths of 1e-116 or more.
constexpr double kFilterUnderflow = 1e-300;

/// Spans that the filter tries before it declines. Cost only: the exact stage takes over.
constexpr int kFilterSpans = 24;
constexpr int kFilterDepth = 12;
/// Half widths of the bracket put around a root: the first leaves the sides of the polygon little
/// room to change sign, the second is the most that the accuracy allows.
constexpr std::array<double, 2> kHalfBrackets = {0x1p-44, 0.25 * kLeafTimeAccuracy};

struct Span {
  double start, width;
  Cubic volume;
  int level;
};

/// Comparing two doubles tells the sign of their difference exactly.
bool separatedOnAnAxis(const MovingPolygon& polygon) {
  for (int axis = 0; axis < 3; ++axis) {
    bool above = true, below = true;
    for (int i = 0; i < polygon.count; ++i) {
      const LinearPoint &p = *polygon.plus[i], &q = *polygon.minus[i];
      above = above && p.from[axis] > q.from[axis] && p.to[axis] > q.to[axis];
      below = below && p.from[axis] < q.from[axis] && p.to[axis] < q.to[axis];
    }
    if (above || below) return true;
  }
  return false;
}

class Filter {
 public:
  explicit Filter(const Corners& corners)
      : corners_(corners), volumeScale_(corners.largestVolume()) {}

  StageAnswer decide() {
    const bool volumes = corners_.count >= 3;
    const Cubic volume = volumes ? volumeOf(corners_) : Cubic{};
    if (volumes && strictSign(volume, volumeBound(0)) != 0) return {Decision::No};
    volume_ = volume;
    std::array<Span, kFilterDepth + 2> stack;
    int size = 0;
    stack[size++] = {0.0, 1.0, volume, 0};
    for (int looked = 0; size > 0; ++looked) {
      if (looked == kFilterSpans) return {};
      const Span span = stack[--size];
      const StageAnswer answer = look(span);
      if (answer.decision == Decision::Yes) return answer;
      if (answer.decision == Decision::No) continue;
      if (declined_ || span.level == kFilterDepth) return {};
      const auto [left, right] = halve(span.volume);
      const double half = 0.5 * span.width;
      stack[size++] = {span.start + half, half, right, span.level + 1};
      stack[size++] = {span.start, half, left, span.level + 1};
    }
    return {Decision::No};
  }

 private:
  double volumeBound(int level) const {
    return (kVolumeRounding + level * kHalvingRounding) * volumeScale_ + kFilterUnderflow;
  }

  StageAnswer look(const Span& span) {
    if (corners_.count >= 3) {
      const double bound = volumeBound(span.level);
      if (strictSign(span.volume, bound) != 0) return {Decision::No};
      if (hasOneRoot(span.volume, bound)) return lookAtRoot(span);
    }
    return separated(span) ? StageAnswer{Decision::No} : StageAnswer{};
  }

  /// One root of f in the span and no other: contact there or nowhere in the span.
  StageAnswer lookAtRoot(const Span& span) {
    const double root = span.start + span.width * rootOf(span.volume);
    const double end = span.start + span.width;
    for (const double half : kHalfBrackets) {
      const double low = std::max(span.start, root - half), high = std::min(end, root + half);
      if (!signsDiffer(low, high)) continue;
      const Decision decision = originInside(low, high);
      if (decision != Decision::CannotTell) return {decision, low, high};
    }
    declined_ = !separated(span);
    return declined_ ? StageAnswer{} : StageAnswer{Decision::No};
  }

  bool signsDiffer(double low, double high) const {
    const double bound = volumeBound(0) + kValueRounding * volumeScale_;
    const double atLow = valueAt(volume_, low), atHigh = valueAt(volume_, high);
    return (atLow > bound && atHigh < -bound) || (atLow < -bound && atHigh > bound);
  }

  /// Is the origin, known to be in the polygon's plane at some instant of [low, high], inside it?
  /// Decides if, seen along some axis, the sides' signs do not change in the bracket.
  Decision originInside(double low, double high) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double bound = kSideRounding * corners_.largestSide(u, v) + kFilterUnderflow;
      int positive = 0, negative = 0;
      for (int j = 0; j < corners_.count; ++j) {
        const int sign = sideSign(j, u, v, low, high, bound);
        positive += sign > 0;
        negative += sign < 0;
      }
      if (positive > 0 && negative > 0) return Decision::No;
      if (positive == corners_.count || negative == corners_.count) return Decision::Yes;
    }
    return Decision::CannotTell;
  }

  /// Sign of component u x v of corner j x corner j+1 if it is strict throughout [low, high].
  int sideSign(int j, int u, int v, double low, double high, double bound) const {
    const CornerSide side = sideOf(corners_, j, u, v);
    const double atLow = valueAt(side, low), atHigh = valueAt(side, high);
    if (atLow > bound && atHigh > bound) return 1;
    return atLow < -bound && atHigh < -bound ? -1 : 0;
  }

  /// Does a fixed plane through the origin keep all corners on one side during the span?
  bool separated(const Span& span) const {
    std::array<Vector3d, 4> start, end, middle;
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < corners_.count; ++i) {
      start[i] = at(i, span.start);
      end[i] = at(i, span.start + span.width);
      middle[i] = 0.5 * (start[i] + end[i]);
      sum += middle[i];
    }
    const auto separates = [&](const Vector3d& direction) {
      const double bound =
          kCornerPlaneRounding * direction.cwiseAbs().dot(corners_.extent) + kFilterUnderflow;
      for (int i = 0; i < corners_.count; ++i) {
        if (!(direction.dot(start[i]) > bound && direction.dot(end[i]) > bound)) return false;
      }
      return true;
    };
    if (separates(sum)) return true;
    for (int i = 0; i < corners_.count; ++i) {
      const Vector3d& a = middle[i];
      const Vector3d ab = middle[corners_.next(i)] - a;
      const double length2 = ab.squaredNorm();
      const double s = length2 > 0.0 ? std::clamp(-a.dot(ab) / length2, 0.0, 1.0) : 0.0;
      if (separates(a + s * ab)) return true;
    }
    return false;
  }

  Vector3d at(int i, double t) const { return (1.0 - t) * corners_.from[i] + t * corners_.to[i]; }

  const Corners& corners_;
  double volumeScale_;
  Cubic volume_{};
  bool declined_ = false;
};

}  // namespace

StageAnswer filterStage(const MovingPolygon& polygon) {
  if (separatedOnAnAxis(polygon)) return {Decision::No};
  return Filter(cornersOf(polygon)).decide();
}

}  // namespace foretouch::internal
