// Two triangles meet iff an edge of one meets the other. Every question is the sign of a
// determinant: of four points in space, or of three seen along an axis.
#include "middleware/exact/triangles_meet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "lss/assert.h"
#include "lss/rounding.h"
#include "middleware/exact/scaled_integer.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Integer;

constexpr double kLargestCoordinate = 1e100;

/// Each of the determinant's six products of three components passes eight roundings: three
/// subtractions, two products, three sums. So does the sum of their magnitudes, to which this is
/// relative; twice eight covers both. Halving it breaks the proof.
constexpr double kDeterminantRounding = 16.0 * kUnitRoundoff;
/// Absorbs underflow: six products below 2^-1074, each times a length of up to 2e100.
constexpr double kDeterminantUnderflow = 1e-200;

using Exact = std::array<Integer, 3>;

/// Each axis by its own power of two: no sign below depends on it.
template <std::size_t N>
std::array<Exact, N> exactly(const std::array<const Vector3d*, N>& points) {
  std::array<Exact, N> exact;
  for (int axis = 0; axis < 3; ++axis) {
    int lowest = internal::kNoExponent;
    for (const Vector3d* p : points) lowest = std::min(lowest, internal::exponentOf((*p)[axis]));
    for (std::size_t i = 0; i < N; ++i)
      exact[i][axis] = internal::scaled((*points[i])[axis], lowest);
  }
  return exact;
}

int signOf(const Integer& value) {
  return value.sign();
}

int exactSideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const auto points = exactly<4>({&a, &b, &c, &d});
  std::array<Exact, 3> from;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[i][axis] = points[i + 1][axis] - points[0][axis];
    }
  }
  const auto& [u, v, w] = from;
  return signOf(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
                u[2] * (v[0] * w[1] - v[1] * w[0]));
}

/// The sign of det(b - a, c - a, d - a): the side of the plane a b c that d is on; 0 if the four
/// are in one plane.
int sideOf(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d u = b - a, v = c - a, w = d - a;
  const double determinant = u.x() * (v.y() * w.z() - v.z() * w.y()) +
                             u.y() * (v.z() * w.x() - v.x() * w.z()) +
                             u.z() * (v.x() * w.y() - v.y() * w.x());
  const Vector3d p = u.cwiseAbs(), q = v.cwiseAbs(), r = w.cwiseAbs();
  const double magnitude = p.x() * (q.y() * r.z() + q.z() * r.y()) +
                           p.y() * (q.z() * r.x() + q.x() * r.z()) +
                           p.z() * (q.x() * r.y() + q.y() * r.x());
  const double bound = kDeterminantRounding * magnitude + kDeterminantUnderflow;
  if (determinant > bound) return 1;
  return determinant < -bound ? -1 : exactSideOf(a, b, c, d);
}

/// On some axis all of one is beyond all of the other.
template <std::size_t M, std::size_t N>
bool apartOnAnAxis(const std::array<Vector3d, M>& one, const std::array<Vector3d, N>& other) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto byAxis = [axis](const Vector3d& x, const Vector3d& y) { return x[axis] < y[axis]; };
    const auto [leastOfOne, mostOfOne] = std::minmax_element(one.begin(), one.end(), byAxis);
    const auto [leastOfOther, mostOfOther] =
        std::minmax_element(other.begin(), other.end(), byAxis);
    if ((*leastOfOne)[axis] > (*mostOfOther)[axis] || (*leastOfOther)[axis] > (*mostOfOne)[axis]) {
      return true;
    }
  }
  return false;
}

using Segment = std::array<Vector3d, 2>;
using Corners = std::array<Vector3d, 3>;

/// A segment and a triangle in one plane, seen along an axis. Each sign is that of the area of
/// three points, as the view shows them.
struct View {
  std::array<int, 3> cornerFromSegment;           // end, end, corner k
  std::array<std::array<int, 3>, 2> endFromEdge;  // corner k, corner k + 1, end

  /// All points are on one line of the view.
  [[nodiscard]] bool isLine() const {
    const auto isZero = [](int sign) { return sign == 0; };
    return std::all_of(cornerFromSegment.begin(), cornerFromSegment.end(), isZero) &&
           std::all_of(endFromEdge[0].begin(), endFromEdge[0].end(), isZero) &&
           std::all_of(endFromEdge[1].begin(), endFromEdge[1].end(), isZero);
  }
};

View seenAlong(int axis, const std::array<Exact, 5>& points) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  const auto turn = [&](const Exact& a, const Exact& b, const Exact& c) {
    return signOf((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
  };
  View view;
  for (std::size_t k = 0; k < 3; ++k) {
    const Exact &corner = points[2 + k], &next = points[2 + (k + 1) % 3];
    view.cornerFromSegment[k] = turn(points[0], points[1], corner);
    for (std::size_t end = 0; end < 2; ++end) {
      view.endFromEdge[end][k] = turn(corner, next, points[end]);
    }
  }
  return view;
}

/// In a view that shows the plane as it is, not as a line.
bool meetIn(const View& view, const Segment& segment, const Corners& corners) {
  const auto& first = view.endFromEdge[0];
  if (first[0] != 0 && first[0] == first[1] && first[1] == first[2]) return true;  // it is inside
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const int a = view.cornerFromSegment[k], b = view.cornerFromSegment[next];
    const int c = view.endFromEdge[0][k], d = view.endFromEdge[1][k];
    if (a * b > 0 || c * d > 0) continue;
    const bool isOneLine = a == 0 && b == 0 && c == 0 && d == 0;
    if (!isOneLine || !apartOnAnAxis(segment, Segment{corners[k], corners[next]})) return true;
  }
  return false;
}

/// All five points are in one plane.
bool meetInPlane(const Segment& segment, const Corners& corners) {
  const auto points = exactly<5>({&segment[0], &segment[1], &corners[0], &corners[1], &corners[2]});
  for (int axis = 0; axis < 3; ++axis) {
    const View view = seenAlong(axis, points);
    if (!view.isLine()) return meetIn(view, segment, corners);
  }
  return !apartOnAnAxis(segment, corners);  // on one line
}

bool meet(const Segment& segment, const Corners& corners) {
  const auto& [a, b] = segment;
  const auto& [p, q, r] = corners;
  const int sideOfA = sideOf(p, q, r, a), sideOfB = sideOf(p, q, r, b);
  if (sideOfA * sideOfB > 0) return false;
  const std::array<int, 3> turns{sideOf(a, b, p, q), sideOf(a, b, q, r), sideOf(a, b, r, p)};
  const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
  // The segment's line crosses the plane in one point, which is in the triangle if it passes all
  // edges on one side.
  if (sideOfA != 0 || sideOfB != 0) return *least >= 0 || *most <= 0;
  // Only a triangle without area has a plane with every point; its line then passes the segment's.
  if (*least != 0 || *most != 0) return false;
  return meetInPlane(segment, corners);
}

[[maybe_unused]] bool isAdmitted(const Triangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(), [](const Vector3d& v) {
    return v.allFinite() && v.cwiseAbs().maxCoeff() <= kLargestCoordinate;
  });
}

/// All corners of one are strictly on one side of the other's plane.
bool isBeside(const Corners& one, const Corners& other) {
  const int side = sideOf(other[0], other[1], other[2], one[0]);
  return side != 0 && side == sideOf(other[0], other[1], other[2], one[1]) &&
         side == sideOf(other[0], other[1], other[2], one[2]);
}

}  // namespace

bool trianglesMeet(const Triangle& one, const Triangle& other) {
  FORETOUCH_ASSERT(isAdmitted(one) && isAdmitted(other));
  const Corners &x = one.vertices, &y = other.vertices;
  if (apartOnAnAxis(x, y) || isBeside(x, y) || isBeside(y, x)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (meet({x[i], x[(i + 1) % 3]}, y) || meet({y[i], y[(i + 1) % 3]}, x)) return true;
  }
  return false;
}

}  // namespace foretouch
