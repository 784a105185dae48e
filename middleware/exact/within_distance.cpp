#include "middleware/exact/within_distance.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "lss/separation.h"
#include "middleware/exact/side_of.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

Integer dot(const Exact& a, const Exact& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Exact cross(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Exact minus(const Exact& a, const Exact& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// A triangle seen from the point, and the distance, all by one power of two: lengths compare.
struct Seen {
  std::array<Exact, 3> corners;
  Integer square;  // of the distance
};

Seen seenExactly(const Vector3d& p, const Triangle& triangle, double distance) {
  int lowest = exponentOf(distance);
  for (int axis = 0; axis < 3; ++axis) {
    lowest = std::min(lowest, exponentOf(p[axis]));
    for (const Vector3d& v : triangle.vertices) lowest = std::min(lowest, exponentOf(v[axis]));
  }
  Seen seen;
  for (std::size_t i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      seen.corners[i][axis] = scaled(triangle.vertices[i][axis], lowest) - scaled(p[axis], lowest);
    }
  }
  const Integer length = scaled(distance, lowest);
  seen.square = length * length;
  return seen;
}

/// The corner, or the line where the foot of the point is between both.
bool isNearEdge(const Exact& a, const Exact& b, const Integer& square) {
  if (dot(a, a) <= square) return true;
  const Exact edge = minus(b, a);
  const Integer along = -dot(a, edge), whole = dot(edge, edge);
  if (signOf(along) <= 0 || along >= whole) return false;
  const Exact across = cross(a, edge);
  return dot(across, across) <= square * whole;
}

/// The plane, where the foot of the point is within the edges.
bool isNearFace(const std::array<Exact, 3>& v, const Integer& square) {
  const Exact normal = cross(minus(v[1], v[0]), minus(v[2], v[0]));
  const Integer whole = dot(normal, normal), height = dot(v[0], normal);
  if (signOf(whole) == 0 || height * height > square * whole) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (signOf(dot(cross(v[i], v[(i + 1) % 3]), normal)) < 0) return false;
  }
  return true;
}

bool isWithinExactly(const Vector3d& p, const Triangle& triangle, double distance) {
  const auto [v, square] = seenExactly(p, triangle, distance);
  for (std::size_t i = 0; i < 3; ++i) {
    if (isNearEdge(v[i], v[(i + 1) % 3], square)) return true;
  }
  return isNearFace(v, square);
}

}  // namespace

bool isWithin(const Vector3d& p, const Triangle& triangle, double distance) {
  const Separation apart = separation(Hull::segment(p, p), Hull::of(triangle));
  if (apart.lower() > distance) return false;
  // What is not a number is within.
  return !(apart.upper > distance) || isWithinExactly(p, triangle, distance);
}

}  // namespace foretouch::internal
