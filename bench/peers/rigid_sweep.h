// bench/peers/rigid_sweep.h: the motion that every solver of `bench peers` solves: one LSS on one
// rigid link, between two poses. Metres in the world W, radians, t in [0,1].
//
// The link's frame L has its origin at a pivot. The pivot moves on a straight line and the link
// turns about it at a constant rate about an axis fixed in W. Every solver can represent this
// motion exactly: Foretouch as a skeleton of one joint at the pivot (articulated/motion.h), FCL as
// an InterpMotion with the pivot as its reference point, Bullet as a shape whose origin is the
// pivot.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/skeleton.h"
#include "lss/lss.h"

namespace foretouch::tools {

struct RigidSweep {
  Lss lss_L;
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< The pivot, W.
  Quaternion rotation = Quaternion::Identity();    ///< L to W at t = 0; unit.
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< Axis in W times angle; angle below pi.
};

struct RigidPose {
  Quaternion rotation = Quaternion::Identity();  ///< L to W.
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
};

[[nodiscard]] RigidPose poseAt(const RigidSweep& sweep, double t);

struct AxisInWorld {
  Eigen::Vector3d a, b;
};
/// The LSS's axis at t.
[[nodiscard]] AxisInWorld axisAt(const RigidSweep& sweep, double t);

/// No point of the axis is ever faster than this (m per unit of t).
[[nodiscard]] double fastestAxisPoint(const RigidSweep& sweep);

/// Displacement of the LSS from t0 to t1 (m): that of its farthest point. The displacement is
/// affine along the axis, so that one of its ends is the farthest.
[[nodiscard]] double displacement(const RigidSweep& sweep, double t0, double t1);

}  // namespace foretouch::tools
