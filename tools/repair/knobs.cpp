#include "tools/repair/knobs.h"

#include <Eigen/Geometry>

#include "lss/index.h"

namespace foretouch::tools {

using Eigen::Vector3d;
std::vector<Vector3d> turnsOf(const std::vector<Knob>& knobs, const Eigen::VectorXd& change,
                              std::size_t joints) {
  std::vector<Vector3d> turns(joints, Vector3d::Zero());
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    for (const Drive& drive : knobs[k].drives) {
      if (drive.turns)
        turns[slotOf(drive.joint)] += change[static_cast<Eigen::Index>(k)] * drive.along;
    }
  }
  return turns;
}

Pose changedPose(const Pose& pose, const std::vector<Knob>& knobs, const Eigen::VectorXd& change) {
  Pose changed = pose;
  const auto turns = turnsOf(knobs, change, pose.rotations.size());
  for (std::size_t j = 0; j < turns.size(); ++j) {
    const double angle = turns[j].norm();
    if (!(angle > 0.0)) continue;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, turns[j] / angle));
    changed.rotations[j] = Quaternion((Eigen::Quaterniond(pose.rotations[j]) * turn).normalized());
  }
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    for (const Drive& drive : knobs[k].drives) {
      if (drive.turns) continue;
      changed.translations[slotOf(drive.joint)] +=
          change[static_cast<Eigen::Index>(k)] * drive.along;
    }
  }
  return changed;
}

}  // namespace foretouch::tools
