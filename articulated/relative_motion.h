// articulated/relative_motion.h: a chain seen from one of its own links: again a skeleton, whose
// in-between motion is the relative one. So whatever is proven of a chain that moves in W also
// holds for a body that moves past a prop that moves itself, for a body and the tool in its hand,
// and for one link and another. Proof with rounding: articulated/relative_motion.md. Metres.
#pragma once

#include <vector>

#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch {

/// All links of a skeleton in the frame of one of its joints. Two bodies are one skeleton with two
/// roots: a body seen from a free prop is that of both, seen from the prop's joint. Immutable.
class RelativeChain {
 public:
  /// Errors: a chain that is too deep or has too many joints so (a link below the frame's root is
  /// deeper by up to the frame's own depth; one joint more per joint above the frame), or whose
  /// roots are more than kMaxCoordinate apart at rest. Precondition: a joint of the skeleton
  /// (asserted). O(joints).
  static Result<RelativeChain> build(const Skeleton& skeleton, JointId frame);

  /// Its world W is the frame. Joints that stand for no link turn the others back.
  [[nodiscard]] const Skeleton& skeleton() const { return skeleton_; }
  /// The link here that is `original`; the frame's own never moves.
  [[nodiscard]] LinkId linkOf(LinkId original) const { return linkOf_[slotOf(original)]; }

  /// The pose here of a pose of the original skeleton, exact but for one rounding per coordinate of
  /// the roots' places relative to each other, which the motion's bounds on rounding include.
  /// Between two such poses the motion is the relative one of the motion between the originals.
  /// Preconditions: a validated pose of the original (asserted); another object than `relative`.
  /// Allocates nothing once `relative` has grown. O(joints).
  void pose(const Pose& original, Pose& relative) const;

 private:
  RelativeChain(const Skeleton& original, JointId frame);

  /// Where a joint's rotation and translation come from.
  struct Source {
    JointId turn = kNoParent;   // its rotation; kNoParent: none
    bool isTurnedBack = false;  // the conjugate of it
    JointId shift = kNoParent;  // plus its translation; kNoParent: zero
    JointId less = kNoParent;   // less that of this one
  };
  /// Returns the joint's number.
  JointId add(JointId parent, const Source& source);
  void addPath(const Skeleton& original, JointId frame);
  void addOthers(const Skeleton& original);

  Skeleton skeleton_;
  std::vector<Source> sources_;   // per joint here
  std::vector<JointId> parents_;  // per joint here
  std::vector<LinkId> linkOf_;    // per original joint
  JointId atWorld_ = kNoParent;   // turned as W, placed at the root of the frame
  JointId rootOfFrame_ = kNoParent;
};

}  // namespace foretouch
