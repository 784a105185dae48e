// middleware/solid/target_pose.h: the tracked pose of one tick, checked, with lost joints held at
// their place on their parents. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "lss/index.h"
#include "middleware/solid/joint_ranges.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::internal {

/// Keeps its memory.
class TargetPose {
 public:
  explicit TargetPose(const Avatar& avatar) : skeleton_(avatar.skeleton()), ranges_(skeleton_) {}

  /// Becomes the target of the next tick. `shown`: what lost joints keep; null: the last target's,
  /// or at first their rest pose. Errors: as validatedPose(), and of a wrong number of flags; then
  /// nothing has changed.
  Result<Done> take(const SolidTarget& given, const Pose* shown);
  /// Moves all of it, but for lost roots, which stay where they are shown.
  void moveRoots(const Eigen::Vector3d& by);
  /// Forgets the last target.
  void reset() {
    isAny_ = hasLast_ = false;
    ranges_.forget();
  }

  [[nodiscard]] const Pose& pose() const { return pose_; }
  [[nodiscard]] bool isLost(JointId joint) const { return isLost_[slotOf(joint)] != 0; }
  /// Whether it was lost in the last tick. Precondition: hasLast().
  [[nodiscard]] bool wasLost(JointId joint) const { return wasLost_[slotOf(joint)] != 0; }
  /// Whether a joint that was lost is tracked again: the target has not moved there.
  [[nodiscard]] bool hasFound() const { return hasFound_; }
  /// The last target. Precondition: hasLast().
  [[nodiscard]] const Pose& last() const { return last_; }
  /// Where it places the links, and where the last target did (which there must be).
  [[nodiscard]] const std::vector<LinkState>& states();
  [[nodiscard]] const std::vector<LinkState>& lastStates();
  [[nodiscard]] bool hasLast() const { return hasLast_; }
  /// How the tracked joints were seen to turn.
  [[nodiscard]] const JointRanges& ranges() const { return ranges_; }
  /// Takes what was seen of the same person before. Precondition: by the same joints.
  void remember(const JointRanges& ranges) { ranges_ = ranges; }

 private:
  Skeleton skeleton_;
  JointRanges ranges_;
  Pose pose_, last_, candidate_;
  std::vector<std::uint8_t> isLost_, wasLost_;
  std::vector<LinkState> states_, lastStates_;
  bool isAny_ = false, hasLast_ = false, hasFound_ = false;
  bool arePlaced_ = false, areLastPlaced_ = false;  // states, found when first asked for
};

}  // namespace foretouch::internal
