// tools/inputs/body_box.h: the space that a body takes in one pose.
#pragma once

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/pose.h"

namespace foretouch::tools {

/// Metres, in the world.
struct BodyBox {
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d size() const { return max - min; }
  /// The middle of its ground plan, at its lowest point.
  [[nodiscard]] Eigen::Vector3d foot() const;
};

/// The box around all LSS of a validated pose; an avatar without LSS has none worth asking for.
[[nodiscard]] BodyBox boxOf(const Avatar& avatar, const Pose& pose);

}  // namespace foretouch::tools
