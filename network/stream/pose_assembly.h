// network/stream/pose_assembly.h: turns a sender's values for some joints of its skeleton into a
// pose of all joints of the avatar, and marks which are known. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "assets/avatar/joint_match.h"
#include "network/wire/messages.h"

namespace foretouch::internal {

/// Why each link is unknown in one of the two poses, or in both: the reason of the first joint that
/// has one, going up from the link's own to its root; the later pose's if both have one. Resizes
/// `reasons`.
void findUnknownLinks(const Skeleton& skeleton, const std::vector<UndecidedReason>& from,
                      const std::vector<UndecidedReason>& to,
                      std::vector<UndecidedReason>& reasons);

/// Keeps the two poses of a step. Allocates only in use().
///
/// A joint is known if it is listed, valid, and tracked or inferred. A joint listed without a
/// translation has its rest offset, unless the sender has sent one for it before in this session or
/// sends one next: then its offset is missing. An unknown joint keeps its last known value, or its
/// rest values if there was none: a value for the query to work with, without meaning.
class PoseAssembly {
 public:
  PoseAssembly(const Skeleton& avatar, bool unmatchedAtRest);

  /// From now on `match` maps a sender's `numSenderJoints` joints to the avatar's; forgets all
  /// poses.
  void use(const JointMatch& match, std::int32_t numSenderJoints);

  /// Whether a message is usable. Next call assemble() with the same message, or nothing.
  /// Precondition: use() was called.
  [[nodiscard]] Reject check(const PoseMessage& message);
  /// The later pose becomes the earlier one, and `message`, just checked, the later. `isSession`:
  /// earlier messages were of another session.
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
  // has sent a translation of it.
  std::vector<std::int32_t> listed_, translated_;
  std::vector<std::uint8_t> isTranslated_;
  Known earlier_, later_;
};

}  // namespace foretouch::internal
