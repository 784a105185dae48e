// tools/repair/knobs.h: what a repair may change in a clip: joints' angles, the root's place, a
// robot's coordinates; each a number that is added, pose by pose. Metres, radians.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/clip.h"
#include "articulated/skeleton.h"

namespace foretouch::tools {

/// What one unit of a knob does to a joint of the clip.
struct Drive {
  JointId joint = 0;
  bool turns = true;
  /// Turns: the axis in the joint's own frame, times radians per unit. Those of one joint add up
  /// to one rotation vector, applied after the joint's rotation. Else: the shift in the parent's
  /// frame, m per unit.
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

struct Knob {
  std::string name;
  std::vector<Drive> drives;
  /// The limits of the knob's number, if it has any; `values`: the number itself, per frame of the
  /// clip.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::vector<double> values;

  [[nodiscard]] bool isLimited() const { return !values.empty(); }
};

/// The changes, per knob (rows) and pose (columns).
using Changes = Eigen::MatrixXd;

/// The rotation vectors that the knobs add, per joint of the clip, for one column.
[[nodiscard]] std::vector<Eigen::Vector3d> turnsOf(const std::vector<Knob>& knobs,
                                                   const Eigen::VectorXd& change,
                                                   std::size_t joints);

/// `pose` of the clip with the change of a column.
[[nodiscard]] Pose changedPose(const Pose& pose, const std::vector<Knob>& knobs,
                               const Eigen::VectorXd& change);

}  // namespace foretouch::tools
