// tools/stream/clip_sender.h: a clip as the messages of a live sender. Pure: no clock, no socket;
// the same clip gives the same messages.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/result.h"
#include "network/wire/messages.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/step_selection.h"

namespace foretouch::tools {

struct SenderOptions {
  std::int32_t avatar = 1;
  std::int64_t startUtimeUs = 0;  ///< When the first pose is captured; the session, too.
  std::string source;             ///< SkeletonMessage::source.
};

/// Sends the avatar's skeleton and the poses of a replay of the same clip, bit for bit, so that a
/// service answers as a replay does. Marks joints that the clip turns as tracked, and the others,
/// which keep their rest values, as inferred. Sends translations of roots and of joints that the
/// clip moves.
class ClipSender {
 public:
  /// The objects of `placed` must outlive the sender.
  ClipSender(const PlacedClip& placed, const StepSelection& steps, const SenderOptions& options);

  /// One more than there are steps.
  [[nodiscard]] std::int64_t numPoses() const { return steps_.count + 1; }
  /// Capture: the start, and the time of the pose in the clip rounded to microseconds. Strictly
  /// increasing. `pose` may be beyond the last one.
  [[nodiscard]] std::int64_t utimeOf(std::int64_t pose) const;

  [[nodiscard]] SkeletonMessage skeleton(std::int64_t sendUtimeUs) const;
  /// Fills `message`, whose sequence is `pose`, from 0. The error is that of poseAtFrame().
  [[nodiscard]] Result<Done> fill(std::int64_t pose, std::int64_t sendUtimeUs,
                                  PoseMessage& message) const;

 private:
  PlacedClip placed_;
  StepSelection steps_;
  SenderOptions options_;
  SkeletonMessage skeleton_;
};

}  // namespace foretouch::tools
