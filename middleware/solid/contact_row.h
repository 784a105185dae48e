// middleware/solid/contact_row.h: one half-space that a small step of a pose must stay in: the gap
// between two features does not close faster than it may. Metres. Not installed.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

/// n.(motion of x on `link`) - n.(motion of y on `other`) >= bound.
struct ContactRow {
  LinkId link = 0;
  std::int32_t lss = -1;
  TriangleId triangle = -1;    ///< In the scene, which rests; or:
  LinkId other = kNoParent;    ///< an own link,
  std::int32_t otherLss = -1;  ///< and its LSS.
  std::int32_t end = -1;  ///< For own links, where an axis ends: 0, 1 of `lss`, 2, 3 of `otherLss`.
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  ///< On the link's surface, in W.
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< On the surface that is touched, in W.
  Eigen::Vector3d n = Eigen::Vector3d::Zero();  ///< Unit, from y to x.
  double gap = 0.0;
  /// For own links that are not asked: how much nearer than the skin the target has them, which is
  /// the person's own affair; and such a row is a wish, which no proof stands behind.
  double slack = 0.0;
  bool isSoft = false;
  /// For a joint's range (joint_ranges.h) instead: n.(turn of `link` on `other`) >= bound. A wish.
  bool isTurn = false;
  bool isFace = false;  ///< A face of the scene holds it, with all that goes on flat around it.
  double along = 0.0;   ///< Then: where on the axis, from end a (0) to end b (1).
  double bound = 0.0;   ///< For the step along n.
  double bias = 0.0;    ///< Added to the bound: what the surfaces' curvature takes.
  double push = 0.0;    ///< The multiplier, >= 0.
};

}  // namespace foretouch::internal
