#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch {
namespace {

Error poseError(ErrorCode code, const Skeleton& skeleton, JointId joint, const std::string& what) {
  Error error;
  error.code = code;
  error.index = joint;
  error.message =
      "joint " + std::to_string(joint) + " " + inQuotes(skeleton.name(joint)) + " " + what;
  return error;
}

}  // namespace

Pose restPose(const Skeleton& skeleton) {
  Pose pose;
  const auto n = countOf(skeleton.numJoints());
  pose.rotations.reserve(n);
  pose.translations.reserve(n);
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    pose.rotations.push_back(skeleton.restRotation(j));
    pose.translations.push_back(skeleton.restOffset(j));
  }
  return pose;
}

Result<Done> validate(const Skeleton& skeleton, Pose& pose) {
  const auto n = countOf(skeleton.numJoints());
  if (pose.rotations.size() != n || pose.translations.size() != n) {
    return Error::of(ErrorCode::Mismatch, "a pose has " + std::to_string(pose.rotations.size()) +
                                              " rotations and " +
                                              std::to_string(pose.translations.size()) +
                                              " translations; expected one of each for " +
                                              std::to_string(n) + " joints");
  }
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    const Quaternion& rotation = pose.rotations[slotOf(j)];
    const Eigen::Vector3d& translation = pose.translations[slotOf(j)];
    if (!rotation.coeffs().allFinite() || !translation.allFinite()) {
      return poseError(ErrorCode::NonFinite, skeleton, j,
                       "has a rotation or translation that is not finite");
    }
    if (translation.cwiseAbs().maxCoeff() > kMaxCoordinate) {
      return poseError(ErrorCode::OutOfRange, skeleton, j,
                       "has a translation beyond 1e7 m; is the unit right?");
    }
    if (!unitQuaternion(rotation)) {
      return poseError(ErrorCode::OutOfRange, skeleton, j,
                       "has a rotation of norm " + std::to_string(rotation.norm()) +
                           "; expected 1 within 0.001");
    }
  }
  for (Quaternion& rotation : pose.rotations) rotation = *unitQuaternion(rotation);
  return Done{};
}

Result<Pose> validatedPose(const Skeleton& skeleton, Pose pose) {
  FORETOUCH_CHECK(validate(skeleton, pose));
  return pose;
}

}  // namespace foretouch
