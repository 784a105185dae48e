// judge/cast_oracle.h: a shape that moves along a line, or rests, among capsules and triangles that
// rest: how near it comes to each, by looking at each. A plane between the whole way and a part, in
// doubles with a margin or across the closest points at the way's end, shows that they stay apart.
// Without one, as the distance of two convex sets is convex along a line, sections find its least.
// The hull of corners is looked at as all their triangles and tetrahedra. In long double.
#pragma once

#include <vector>

#include "judge/vector.h"
#include "judge/world_judge.h"

namespace foretouch::oracle {

/// A segment with a radius, and the line that it moves along.
struct CastShape {
  Vec3d a, b;
  double radius = 0.0;
  Vec3d direction;  ///< Of any length; zero: it rests.
  /// Not empty: instead of the segment, what is within the radius of the triangles and tetrahedra
  /// of corners, from a.
  std::vector<Vec3d> corners{};
  std::vector<Corners<Real>> outer{};  ///< Triangles with no corner on one side.
  std::vector<std::array<Vec3r, 4>> tetrahedra{};

  /// All of them; scaled about their middle.
  void setHull(const std::vector<Vec3d>& given, Real scale);
};

/// The distance of the shape, moved so far, and the part, less both radii: 0 where they touch.
[[nodiscard]] Real gapAfter(const CastShape& shape, Real along, const OraclePart& part);
/// The least of these up to `until`; for parts proven farther than `beyond`, at least that.
[[nodiscard]] Real leastGap(const CastShape& shape, Real until, const OraclePart& part,
                            Real beyond);
/// How far it has moved when it first touches the part; -1 if it does not up to `until`.
[[nodiscard]] Real firstTouch(const CastShape& shape, Real until, const OraclePart& part);
/// Whether p is outside the hull of corners; false: in it, or near it, or not known.
[[nodiscard]] bool isClearlyOutside(const Vec3d& p, const std::vector<Vec3d>& corners);
/// In a tetrahedron, which has a volume.
[[nodiscard]] bool isIn(const Vec3r& p, const std::array<Vec3r, 4>& tetrahedron);
/// A point's way up to `until` passes through a triangle, farther than `margin` from its edges and
/// from both ends of the way, and not along it.
[[nodiscard]] bool surelyCrosses(const CastShape& shape, Real until, const OraclePart& part,
                                 Real margin);
/// Whether a ray crosses the closed surface an odd number of times: the first of fifty that passes
/// near no edge, or, where each does, one more.
[[nodiscard]] bool isInside(const Vec3r& p, const std::vector<Corners<Real>>& surface);
/// The distance of a point from the part's surface; negative for a point in a capsule.
[[nodiscard]] Real heightOver(const Vec3d& p, const OraclePart& part);

}  // namespace foretouch::oracle
