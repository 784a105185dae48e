// middleware/solid/target_pose.h: the tracked pose of one tick, checked, with lost joints held at
// their place on their parents. Not installed.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/solid/solid_avatar.h"

namespace foretouch::internal {

/// Keeps its memory.
class TargetPose {
 public:
  explicit TargetPose(const Avatar& avatar) : skeleton_(avatar.skeleton()) {}

  /// Becomes the target of the next tick. `shown`: what lost joints keep; null: the last target's,
  /// or at first their rest pose. Errors: as validatedPose(), and of a wrong number of flags; then
  /// nothing has changed.
  Result<Done> take(const SolidTarget& given, const Pose* shown);
  /// Forgets the last target.
  void reset() { hasLast_ = false; }

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] bool isLost(JointId joint) const { return isLost_[slotOf(joint)] != 0; }
  /// Of any joint's origin, from the last target to this one (m); 0 for the first.
  [[nodiscard]] double largestStep() const { return largestStep_; }

 private:
  Skeleton skeleton_;
  Pose pose_, last_, candidate_;
  std::vector<std::uint8_t> isLost_;
  std::vector<LinkState> states_, lastStates_;
  double largestStep_ = 0.0;
  bool hasLast_ = false;
};

}  // namespace foretouch::internal
