// judge/distance.h: the oracle's own distance of a segment and a triangle. The least over all pairs
// of features whose closest points lie inside both: end point and face, segment and edge, end point
// and edge, vertex and segment; zero if the segment pierces the face. It clamps nothing and uses no
// signs of areas: the triangle gets an orthonormal frame along its longest edge, so slivers lose no
// digits (coordinates in it err by rounding times the distance, not times the triangle's length
// over its height). If rounding excludes a feature, its closest point lies within rounding of a
// neighbouring feature, which then counts.
#pragma once

#include <array>

#include "judge/vector.h"

namespace foretouch::oracle {

template <typename S>
struct Closest {
  S distance = 0;
  Vec3<S> onSegment, onTriangle;
};

/// Any input is legal, zero lengths and zero areas included. The error is a few roundings of the
/// largest difference of coordinates. Instances: double, Real, Wide.
template <typename S>
Closest<S> closestPoints(const Vec3<S>& a, const Vec3<S>& b, const Corners<S>& v);

/// The same for two triangles; `onSegment` lies on the first. If they meet, the distance is zero.
template <typename S>
Closest<S> closestPoints(const Corners<S>& one, const Corners<S>& other);

/// Distance of a point and a segment. Instances: double, Real.
template <typename S>
S pointSegmentDistance(const Vec3<S>& p, const Vec3<S>& a, const Vec3<S>& b);

}  // namespace foretouch::oracle
