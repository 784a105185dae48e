#include "tests/reference/filter_corners.h"

#include <Eigen/Geometry>

namespace foretouch::internal {

using Eigen::Vector3d;

Corners cornersOf(const MovingPolygon& polygon) {
  Corners corners;
  corners.count = polygon.count;
  for (int i = 0; i < polygon.count; ++i) {
    corners.from[i] = polygon.plus[i]->from - polygon.minus[i]->from;
    corners.to[i] = polygon.plus[i]->to - polygon.minus[i]->to;
    corners.extent = corners.extent.cwiseMax(corners.from[i].cwiseAbs());
    corners.extent = corners.extent.cwiseMax(corners.to[i].cwiseAbs());
  }
  return corners;
}

Cubic volumeOf(const Corners& c) {
  const Vector3d first = c.from[0].cross(c.from[1]);
  const Vector3d twiceMiddle = c.from[0].cross(c.to[1]) + c.to[0].cross(c.from[1]);
  const Vector3d last = c.to[0].cross(c.to[1]);
  return {3.0 * first.dot(c.from[2]), twiceMiddle.dot(c.from[2]) + first.dot(c.to[2]),
          twiceMiddle.dot(c.to[2]) + last.dot(c.from[2]), 3.0 * last.dot(c.to[2])};
}

CornerSide sideOf(const Corners& corners, int j, int u, int v) {
  const Vector3d &a = corners.from[j], &b = corners.from[corners.next(j)];
  const Vector3d &c = corners.to[j], &d = corners.to[corners.next(j)];
  return {a[u] * b[v] - a[v] * b[u], (a[u] * d[v] - a[v] * d[u]) + (c[u] * b[v] - c[v] * b[u]),
          c[u] * d[v] - c[v] * d[u]};
}

}  // namespace foretouch::internal
