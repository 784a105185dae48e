// middleware/ask/convex_shape.h: the convex hull of corners, solid, and how far it is from a piece
// of the world. Metres. Not installed.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "articulated/result.h"
#include "lss/lss.h"
#include "lss/separation.h"
#include "middleware/depth/body_places.h"

namespace foretouch::internal {

/// Its corners, from a place inside it that moves with it.
struct ConvexShape {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();  ///< Its box.
  double extent = 0.0;  ///< No corner's 1-norm is larger.

  /// Replaces all by `given` from `place`, which becomes their middle. Returns what both round by.
  double assign(const std::vector<Eigen::Vector3d>& given, Eigen::Vector3d& place);
  /// Replaces `seen` by the same as seen from the frame. Returns the rounding that this adds.
  double seenFrom(const LinkPlace& frame, ConvexShape& seen) const;

 private:
  void measure();
};

/// For the hull and a piece, as separation() of two hulls: bounds that all corners prove,
/// which a search for the closest three proposes (ask.md 7).
[[nodiscard]] Separation separation(const ConvexShape& shape, const Eigen::Vector3d& place,
                                    const Hull& piece);

/// Corners that are finite, within the limit, and not too many; from `shape`, whose ends are alike.
[[nodiscard]] Result<Done> checkedHull(const std::vector<Eigen::Vector3d>& hull, const Lss& shape);

}  // namespace foretouch::internal
