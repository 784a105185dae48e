#include <algorithm>
#include <cmath>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "tessellation/swept_lss.h"
#include "tools/glb/replay_scene.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Floats resolve 4 micrometres up to here; beyond, positions are relative to a nearby origin.
constexpr double kNear = 64.0;

Vector3d originOf(const Stage& stage) {
  const Skeleton& skeleton = stage.inputs.avatar.skeleton();
  Vector3d low = stage.poses.front().translations[0], high = low;
  for (const Pose& pose : stage.poses) {
    for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
      if (skeleton.parent(joint) != kNoParent) continue;
      low = low.cwiseMin(pose.translations[slotOf(joint)]);
      high = high.cwiseMax(pose.translations[slotOf(joint)]);
    }
  }
  return originFor(low, high);
}

double extentOf(const Stage& stage) {
  const Avatar& avatar = stage.inputs.avatar;
  const ChainMotion motion(avatar.skeleton(), stage.poses[0], stage.poses[1]);
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      const AxisEnds ends = axisEnds(lss, motion.stateAt(link, 0.0));
      low = low.cwiseMin((ends.a.cwiseMin(ends.b).array() - lss.radius).matrix());
      high = high.cwiseMax((ends.a.cwiseMax(ends.b).array() + lss.radius).matrix());
    }
  }
  constexpr double kLeast = 1e-3;  // markers of an avatar that is a point
  return std::max(kLeast, (high - low).norm());
}

}  // namespace

Vector3d originFor(const Vector3d& low, const Vector3d& high) {
  if (low.cwiseAbs().maxCoeff() <= kNear && high.cwiseAbs().maxCoeff() <= kNear) {
    return Vector3d::Zero();
  }
  // Whole metres: floats hold them exactly up to 16,777 km.
  return (0.5 * (low + high)).array().round();
}

Result<Stage> stageOf(const ReplayInputs& inputs) {
  std::vector<Pose> poses;
  std::vector<double> timesS;
  for (std::int64_t step = 0; step <= inputs.steps.count; ++step) {
    FORETOUCH_TRY(auto pose, poseAtFrame(inputs, inputs.steps.frameOf(step)));
    poses.push_back(std::move(pose));
    timesS.push_back(inputs.timeOfStep(step));
  }
  return stageOf(inputs, std::move(poses), std::move(timesS));
}

Result<Stage> stageOf(const ReplayInputs& inputs, std::vector<Pose> poses,
                      std::vector<double> timesS) {
  Stage stage{inputs, std::move(poses), std::move(timesS)};
  FORETOUCH_CHECK(checkTimes(stage.timesS));
  stage.origin = originOf(stage);
  stage.extent = extentOf(stage);
  return stage;
}

}  // namespace foretouch::tools
