// bench/peers/fcl_capsule.h: an LSS as FCL's own shape. Knows FCL's types: only for the sources of
// the peers.
#pragma once

#include <fcl/geometry/shape/capsule.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "bench/peers/rigid_sweep.h"
#include "lss/turn_between.h"

namespace foretouch::tools {

/// FCL's capsule lies along z around its frame's origin: that frame C in the link's frame L.
struct FclCapsule {
  explicit FclCapsule(const Lss& lss_L)
      : center_L(0.5 * (lss_L.a + lss_L.b)),
        rotation_LC(
            turnBetween(Eigen::Vector3d::UnitZ(), lss_L.b - lss_L.a)),
        shape(lss_L.radius, (lss_L.b - lss_L.a).norm()) {}

  [[nodiscard]] fcl::Transform3d poseOf(const RigidPose& pose_WL) const {
    const Eigen::Quaterniond rotation_WL(pose_WL.rotation);
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.linear() = (rotation_WL * rotation_LC).toRotationMatrix();
    pose.translation() = pose_WL.pivot + rotation_WL * center_L;
    return pose;
  }
  /// The pivot, which is L's origin, in C.
  [[nodiscard]] Eigen::Vector3d pivot_C() const { return -(rotation_LC.conjugate() * center_L); }

  Eigen::Vector3d center_L;
  Eigen::Quaterniond rotation_LC;
  fcl::Capsuled shape;
};

}  // namespace foretouch::tools
