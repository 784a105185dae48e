// network/stream/avatar_stream.h: the meaning of one avatar's stream of messages: which poses it
// accepts, and which step each of them ends. A pure state machine: no clock, no socket, no thread.
// Its decisions depend on the messages and their order alone, so that a recorded stream repeats
// them.
//
// A timeline is a run of accepted poses of one session and one skeleton: sequence and capture time
// both grow from each to the next. The first pose of a timeline ends no motion: its step is the
// instant itself (StepKind::First). A sequence that skips is a gap: the step is marked AcrossGap,
// and nothing is clear in it, since the poses between are unknown. So is the next step after the
// stream refused a lower sequence with a later capture time: its sender may have been restarted.
//
// The stream refuses and counts messages that do not continue the timeline. A new timeline begins
// with
//   - the first pose of another skeleton (said of a later session, or of the same session and a
//     later generation; or any other, said StreamPolicy::confirmations times in a row),
//   - the last of so many poses in a row of the skeleton that was in use before,
//   - the first pose of another speaker (changeSpeaker()),
//   - a pose of a later session,
//   - the last of StreamPolicy::confirmations poses in a row that continue one another but not the
//     timeline (a clock that was set, a sender without sessions that was restarted): one odd stamp
//     changes nothing, and we follow a stream that really jumped after a few poses.
// None of the last 256 answered poses is answered again, whatever begins.
// docs/streaming.md, "What is accepted", has the whole table.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "network/stream/stream_policy.h"
#include "network/wire/messages.h"

namespace foretouch {

/// A sender that skips more poses at once has set its numbers, or lies: they do not count as lost.
inline constexpr std::int64_t kMostCountedLost = 1'000'000;

/// The step that an accepted pose ends. Valid until the stream takes the next message.
struct StreamStep {
  StepKind kind = StepKind::First;
  const Pose* from = nullptr;  ///< Validated poses of the avatar; the same one for First.
  const Pose* to = nullptr;
  std::int64_t session = 0;
  std::int64_t sequenceFrom = 0, sequenceTo = 0;
  std::int64_t utimeFromUs = 0, utimeToUs = 0;
  std::int64_t skeletonHash = 0;
  std::int64_t lost = 0;  ///< Poses between the two; may be 0 AcrossGap (see above).
  /// Per link: why it is undecided whatever the query finds; None: the query decides. Never Gap:
  /// `kind` applies that to all links that would be clear.
  const std::vector<UndecidedReason>* unknown = nullptr;
  /// Per joint of the later pose: why it is not known; None: it is.
  const std::vector<UndecidedReason>* unknownJoints = nullptr;
};

struct StreamCounts {
  std::uint64_t poses = 0;      ///< Received, accepted or not.
  std::uint64_t accepted = 0;   ///< Each ends a step.
  std::uint64_t lost = 0;       ///< Poses between accepted ones of one timeline.
  std::uint64_t gaps = 0;       ///< Steps AcrossGap.
  std::uint64_t vastGaps = 0;   ///< Those across more than kMostCountedLost poses.
  std::uint64_t timelines = 0;  ///< Begun.
  RejectCounts rejects{};       ///< Refused poses and skeletons.
};

class AvatarStream {
 public:
  /// Copies `avatar`. Errors: a policy out of range (names the field).
  static Result<AvatarStream> make(const Avatar& avatar, const StreamPolicy& policy);
  AvatarStream(AvatarStream&&) noexcept;
  AvatarStream& operator=(AvatarStream&&) noexcept;
  ~AvatarStream();

  /// None if the skeleton is in use already, or will be from its first accepted pose on.
  [[nodiscard]] Reject take(const SkeletonMessage& message);
  /// None if it accepts the pose; `step` is then the step that it ends. Allocates nothing.
  [[nodiscard]] Reject take(const PoseMessage& message, StreamStep& step);

  /// From now on, until a pose is accepted, messages are another sender's: order and clock of the
  /// last one prove nothing about them. A skeleton is then never too old, and a pose begins a
  /// timeline. Still answers no pose twice.
  void changeSpeaker();

  /// Whether the last message, if it was refused, may decide about later ones: it counts into a run
  /// that begins a timeline. A stream without the others answers alike.
  [[nodiscard]] bool leftTrace() const;
  /// The skeletons whose poses may be accepted: the one in use, and another one.
  [[nodiscard]] std::array<std::optional<std::int64_t>, 2> knownHashes() const;
  [[nodiscard]] const StreamCounts& counts() const { return counts_; }

 private:
  struct Impl;
  explicit AvatarStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
  StreamCounts counts_;
};

}  // namespace foretouch
