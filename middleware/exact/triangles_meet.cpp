// Two triangles meet iff an edge of one meets the other. Every question is the sign of a
// determinant: of four points in space, or of three seen along an axis.
#include "middleware/exact/triangles_meet.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "lss/assert.h"
#include "middleware/exact/side_of.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::Exact;
using internal::exactly;
using internal::sideOf;
using internal::signOf;

constexpr double kLargestCoordinate = 1e100;

/// Whether on some axis all of one is beyond all of the other.
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

  /// Whether all points are on one line of the view.
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

/// Whether all corners of one are strictly on one side of the other's plane.
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
