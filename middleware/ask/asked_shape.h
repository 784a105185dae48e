// middleware/ask/asked_shape.h: a shape on its way, or at rest, against one convex piece of the
// world: where they first touch, or how far they are apart. Proven by planes: ask.md. Metres, all
// in one frame. Not installed.
#pragma once

#include <Eigen/Core>

#include "lss/lss.h"
#include "lss/separation.h"
#include "middleware/ask/convex_shape.h"
#include "middleware/depth/body_places.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// A shape on its way, or at rest, in a frame in which the pieces rest.
struct AskedShape {
  Lss lss;                                        ///< Where it begins.
  const ConvexShape* hull = nullptr;              ///< Or null; corners from lss.a.
  Eigen::Vector3d way = Eigen::Vector3d::Zero();  ///< Unit; zero: it rests.
  double reach = 0.0;                             ///< How far it moves; at rest, how far is near.
  double moved = 0.0;                             ///< How far it had moved before it was here.
  double rounding = 0.0;  ///< No point of it or of a piece is farther from where it is given.
  double ofWay = 0.0;     ///< Nor is the true unit way farther from `way`, beside its own rounding.

  [[nodiscard]] bool moves() const { return !way.isZero(0.0); }
  [[nodiscard]] bool isRay() const {
    return moves() && hull == nullptr && lss.a == lss.b && lss.radius == 0.0;
  }
  /// Takes corners, if there are any, instead of the axis, from its place; refers to `memory`.
  void takeHull(const std::vector<Eigen::Vector3d>& corners, ConvexShape& memory);
  /// The box around where it begins, without its radius.
  [[nodiscard]] Aabb box() const;
  /// The same after it has moved so far; it may go no farther than `until` then.
  [[nodiscard]] AskedShape movedBy(double along, double until) const;
  /// The same as seen from the frame; rounding grows by what that adds. `memory`: of a hull, to
  /// which it refers.
  [[nodiscard]] AskedShape seenFrom(const LinkPlace& frame, ConvexShape& memory) const;
};

/// How a shape meets a piece.
struct Meeting {
  double distance = 0.0;  ///< Along the way, from here; or between the two.
  Separation apart;       ///< That of the shape's axis and the piece there.
};

/// As separation() of the shape after it has moved so far and the piece, without their radii, with
/// more planes tried where rounding tilts the one between.
[[nodiscard]] Separation apartAfter(const AskedShape& shape, double along, const Hull& piece);

/// False: proven to miss it, or to be farther than the reach. `radius`: the piece's.
[[nodiscard]] bool meets(const AskedShape& shape, const Hull& piece, double radius,
                         Meeting& meeting);

/// Proven: the line of a point's way misses the triangle. False: it may hit.
[[nodiscard]] bool lineMisses(const AskedShape& shape, const Triangle& triangle);

}  // namespace foretouch::internal
