#include "middleware/solid/target_pose.h"

#include <algorithm>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/solid/tree_pose.h"

namespace foretouch::internal {

Result<Done> TargetPose::take(const SolidTarget& given, const Pose* shown) {
  const auto n = countOf(skeleton_.numJoints());
  if (given.isTracked != nullptr && given.isTracked->size() != n) {
    return Error::in("isTracked", ErrorCode::Mismatch,
                     "expected one flag per joint: " + std::to_string(n));
  }
  candidate_ = given.pose;
  FORETOUCH_CHECK(validate(skeleton_, candidate_));
  std::swap(pose_, last_);
  std::swap(states_, lastStates_);
  areLastPlaced_ = std::exchange(arePlaced_, false);
  hasLast_ = std::exchange(isAny_, true);
  std::swap(pose_, candidate_);
  std::swap(isLost_, wasLost_);
  isLost_.assign(n, 0);
  hasFound_ = false;
  for (std::size_t j = 0; given.isTracked != nullptr && j < n; ++j) {
    if ((*given.isTracked)[j] != 0) continue;
    isLost_[j] = 1;
    const auto joint = static_cast<JointId>(j);
    const Pose* const kept = shown != nullptr ? shown : hasLast_ ? &last_ : nullptr;
    pose_.rotations[j] = kept != nullptr ? kept->rotations[j] : skeleton_.restRotation(joint);
    pose_.translations[j] = kept != nullptr ? kept->translations[j] : skeleton_.restOffset(joint);
  }
  ranges_.learn(pose_, isLost_);
  for (std::size_t j = 0; hasLast_ && j < n; ++j) {
    hasFound_ = hasFound_ || (wasLost_[j] != 0 && isLost_[j] == 0);
  }
  return Done{};
}

void TargetPose::moveRoots(const Eigen::Vector3d& by) {
  if (by.isZero(0.0)) return;
  for (std::size_t j = 0; j < pose_.translations.size(); ++j) {
    if (skeleton_.parents()[j] == kNoParent && isLost_[j] == 0) pose_.translations[j] += by;
  }
  arePlaced_ = false;
}

const std::vector<LinkState>& TargetPose::states() {
  if (!std::exchange(arePlaced_, true)) placeLinks(skeleton_, pose_, states_);
  return states_;
}

const std::vector<LinkState>& TargetPose::lastStates() {
  if (hasLast_ && !std::exchange(areLastPlaced_, true)) placeLinks(skeleton_, last_, lastStates_);
  return lastStates_;
}

}  // namespace foretouch::internal
