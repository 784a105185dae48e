#include "tools/repair/knobs.h"

#include <Eigen/Geometry>

#include "lss/index.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// What turning costs beside what it moves: as if each joint carried something at 0.1 m. Without it
/// fingers and toes, which move little, would turn far.
constexpr double kTurnCost = 0.01;
/// The same of shifts: the share of the body that they count as at least.
constexpr double kShiftCost = 0.05;

bool isBelow(const Skeleton& skeleton, JointId joint, JointId top) {
  while (joint > top) joint = skeleton.parent(joint);
  return joint == top;
}

}  // namespace

std::vector<Vector3d> turnsOf(const std::vector<Knob>& knobs, const Eigen::VectorXd& change,
                              std::size_t joints) {
  std::vector<Vector3d> turns(joints, Vector3d::Zero());
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    for (const Drive& drive : knobs[k].drives) {
      if (drive.turns) turns[slotOf(drive.joint)] += change[static_cast<Eigen::Index>(k)] * drive.along;
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
      changed.translations[slotOf(drive.joint)] += change[static_cast<Eigen::Index>(k)] * drive.along;
    }
  }
  return changed;
}

void weigh(const Skeleton& skeleton, std::vector<Knob>& knobs) {
  std::vector<LinkState> states;
  placeLinks(skeleton, restPose(skeleton), states);
  const double joints = static_cast<double>(skeleton.numJoints());
  for (Knob& knob : knobs) {
    double weight = 0.0;
    for (const Drive& drive : knob.drives) {
      const double square = drive.along.squaredNorm();
      double moved = 0.0;
      for (JointId j = drive.joint; j < skeleton.numJoints(); ++j) {
        if (!isBelow(skeleton, j, drive.joint)) continue;
        const Vector3d arm = states[slotOf(j)].p_WL - states[slotOf(drive.joint)].p_WL;
        moved += drive.turns ? arm.squaredNorm() : 1.0;
      }
      weight += square * (moved / joints + (drive.turns ? kTurnCost : kShiftCost));
    }
    knob.weight = weight;
  }
}

}  // namespace foretouch::tools
