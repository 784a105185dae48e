// network/stream/pose_assembly.h: from what a sender says of some joints of its skeleton to a pose
// of all joints of the avatar, with what is known of each. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/pose.h"
#include "articulated/skeleton.h"
#include "assets/avatar/joint_match.h"
#include "network/wire/messages.h"
#include "network/wire/reject.h"

namespace foretouch::internal {

/// Why each link cannot be known in one of the two poses, or in both: the reason of the first joint
/// that has one, going up from the link's own to its root; the later pose's where both have one.
/// `reasons` is resized.
void findUnknownLinks(const Skeleton& skeleton, const std::vector<UndecidedReason>& from,
                      const std::vector<UndecidedReason>& to,
                      std::vector<UndecidedReason>& reasons);

/// Keeps the two poses of a step. Allocates in use() alone.
///
/// A joint is known where it is listed, valid, and tracked or inferred. One that is listed without
/// a translation has its rest offset, unless the sender has said one of it before in this session
/// or says one next: then the offset is one that was not sent. What is unknown keeps its last known
/// value, the rest values before there was any: some value for a query to work with, which says
/// nothing.
class PoseAssembly {
 public:
  PoseAssembly(const Skeleton& avatar, bool unmatchedAtRest);

  /// From now on `match` says which joint of a sender's `numSenderJoints` drives which; forgets all
  /// poses.
  void use(const JointMatch& match, std::int32_t numSenderJoints);

  /// Whether a message says something that can be used. Must be followed by assemble() of the same
  /// message, or nothing. Precondition: use() was called.
  [[nodiscard]] Reject check(const PoseMessage& message);
  /// The later pose becomes the earlier one, and `message`, which was just found good, the later.
  /// `isSession`: what was sent before was another session's.
  void assemble(const PoseMessage& message, bool isSession);

  struct Known {
    Pose pose;                             ///< As validatedPose() makes it.
    std::vector<UndecidedReason> reasons;  ///< Per joint: why it is unknown; None: known.
  };
  [[nodiscard]] const Known& earlier() const { return earlier_; }
  [[nodiscard]] const Known& later() const { return later_; }

 private:
  [[nodiscard]] Reject checkJoints(const PoseMessage& message);
  [[nodiscard]] Reject checkTranslations(const PoseMessage& message);
  void assembleJoint(std::size_t joint, const PoseMessage& message);
  [[nodiscard]] UndecidedReason reasonOf(std::size_t sender, const PoseMessage& message) const;

  Skeleton avatar_;
  bool unmatchedAtRest_;
  std::vector<JointId> senderJointOf_;
  // Per joint of the sender: where the checked message has it, or kNowhere; whether this session
  // has translated it.
  std::vector<std::int32_t> listed_, translated_;
  std::vector<std::uint8_t> isTranslated_;
  Known earlier_, later_;
};

}  // namespace foretouch::internal
