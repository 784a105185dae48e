// network/vmc/vmc_stream.h: what one sender of VMC says of one avatar, datagram by datagram, as the
// messages that every other sender sends: a skeleton, and a pose for each frame. A pure state
// machine: no clock, no socket. Not installed.
//
// VMC has no frames: bones come in bundles or one by one. A frame ends
//   - with the datagram that brings the last of the bones that the sender has been sending,
//   - before a bone that it has already, or
//   - before another time of the sender's clock (/VMC/Ext/T).
// Nothing is numbered, so poses are (kFirstUncounted), and no step of theirs is consecutive. As
// long as every frame is one datagram that says its own time, in which lies no pose of two
// instants, the sender's clock counts; from the first other frame of a session on there is none
// (kFirstUntimed).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "network/vmc/osc.h"
#include "network/vmc/vmc_body.h"
#include "network/wire/messages.h"

namespace foretouch {

/// A bone that so many frames have lacked is waited for no more.
inline constexpr std::int64_t kVmcFramesMissed = 10;
/// A skeleton is said again after so long (us).
inline constexpr std::int64_t kVmcSkeletonEveryUs = 1'000'000;
/// The sender's clock is a float, which from here on is too coarse (s): kUncountedClockUs.
inline constexpr double kMostVmcTime = 65536.0;
/// A clock that jumps by more, or leaves the receipts by more, was set (s): a session begins.
inline constexpr double kVmcClockJump = 1.0;

class VmcStream {
 public:
  /// `body` outlives this.
  explicit VmcStream(const VmcBody& body);

  struct Said {
    std::optional<SkeletonMessage> skeleton;  ///< Before the pose.
    PoseMessage pose;
    std::int64_t receiveUtimeUs = 0;  ///< The frame's last datagram's.
  };
  /// Appends what the datagram completes. False: not an OSC packet, and nothing of it counts.
  [[nodiscard]] bool take(ByteView datagram, std::int64_t receiveUtimeUs, std::vector<Said>& said);

 private:
  void takeMessage(const OscMessage& message, std::vector<Said>& said);
  void takeState(const OscMessage& message);
  void closeBefore(double time, std::vector<Said>& said);
  void takeRoot(const OscMessage& message, std::vector<Said>& said);
  void takeBone(const OscMessage& message, std::vector<Said>& said);
  void touch();
  void close(std::vector<Said>& said);
  [[nodiscard]] bool isComplete() const;
  [[nodiscard]] bool isExpected(std::int64_t seenIn) const {
    return seenIn > 0 && frames_ - seenIn < kVmcFramesMissed;
  }
  void say(const VmcFrame& frame, std::vector<Said>& said);
  [[nodiscard]] bool place(const VmcFrame& frame, std::int64_t& utimeUs);
  void begin(const VmcFrame& frame, bool isTimed);

  const VmcBody* body_;
  // The open frame, and what it was made of.
  VmcFrame open_;
  bool hasBones_ = false, hasRoot_ = false;
  std::int64_t datagram_ = 0, firstDatagram_ = 0;
  bool isOfOne_ = true;
  // Of the sender.
  std::int64_t now_ = 0;
  bool isLoaded_ = true, isTracked_ = true;
  std::int64_t frames_ = 0;           // closed
  std::vector<std::int64_t> seenIn_;  // per bone: the last frame with it, from 1
  std::int64_t rootSeenIn_ = 0;
  // Of the session.
  std::int64_t session_ = 0, count_ = 0, lastUtimeUs_ = 0, baseUs_ = 0;
  double lastTime_ = 0.0;
  bool isTimed_ = false;
  std::vector<bool> bones_;  // that it has said
  RawSkeleton skeleton_;
  std::int64_t hash_ = 0, skeletonSaidUs_ = 0;
  std::int32_t generation_ = 0;
};

}  // namespace foretouch
