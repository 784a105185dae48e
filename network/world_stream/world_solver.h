// network/world_stream/world_solver.h: answers a moving world live: what avatars' streams and
// messages about bodies say goes onto one timeline, and each advance of the watermark becomes
// events_t. No clock, no socket, no thread: the answers follow from the accepted messages, their
// receipts and their order alone. The service, the replay of a log and the simulator run the same
// code, so their answers are equal, byte for byte.
//
// The watermark is where all that is waited for is known: the earliest last pose of the bodies that
// are not silent (WorldPolicy::waitUs). Nothing is claimed of what is not known: messages list it
// (UnknownPart), and mark events that rest on it. Clocks of senders are compared with the receipts,
// by one clock: no sender can hold up the others for longer than waitUs, or hurry them: the
// watermark never passes the newest receipt, and a body that is too late for it, but in time, is
// waited for from then on. Solid bodies (WorldSetup::ServedAvatar::solid) go on with the watermark:
// what they show, and what presses against them, comes beside the events, which are about what is
// shown. docs/streaming.md, "A moving world", has the whole story. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/result.h"
#include "network/stream/avatar_stream.h"
#include "network/wire/messages.h"
#include "network/wire/world_messages.h"
#include "network/world_stream/shown_body.h"
#include "network/world_stream/world_counts.h"
#include "network/world_stream/world_setup.h"

namespace foretouch {

class WorldSolver {
 public:
  /// Errors: a policy out of range (names the field); shapes or avatars that do not differ, or are
  /// not there; solid bodies without a scene, too many of them, with own links that are asked, or
  /// beside a body of kClockGroup; those of World::build(), WorldSetup::ask and SolidWorld::add().
  static Result<WorldSolver> make(WorldSetup setup, const WorldPolicy& policy);
  WorldSolver(WorldSolver&&) noexcept;
  WorldSolver& operator=(WorldSolver&&) noexcept;
  ~WorldSolver();

  /// Each says whether the message is accepted. What is refused changes nothing, and counts.
  [[nodiscard]] Reject take(const BodyMessage& message, std::int64_t receiveUtimeUs);
  /// None if any of its bodies accepts its pose; the others count, too. Else the first reason.
  [[nodiscard]] Reject take(const RigidPoseMessage& message, std::int64_t receiveUtimeUs);
  /// The step of an accepted pose_t. A pose that the world refuses is answered all the same.
  [[nodiscard]] Reject take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs);
  /// From now on, until a pose is accepted, messages about the body are another sender's.
  void changeSpeaker(BodyNumber body);
  /// A state, or a body's pose, was refused before it came here.
  void refusedState(Reject reason);
  /// `body`: kNoBody where it is not known whose pose it is.
  void refusedPose(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs);
  /// The last take() changed which bodies are waited for, though it refused the message: so a
  /// replay needs it, too.
  [[nodiscard]] bool isNoted() const;
  /// Why the last rigid_pose_t's pose of each of its bodies was refused.
  [[nodiscard]] const std::vector<Reject>& reasons() const;

  /// After each take(): moves the watermark as far as it can, and fills `answers`, but for the
  /// stamps of receiving and sending; nothing if it did not move. Keeps their memory.
  void advance(std::vector<EventsMessage>& answers);
  /// What solid bodies showed in the last advance(), tick by tick; events are about that.
  [[nodiscard]] std::vector<ShownBody>& shown();

  [[nodiscard]] bool isThere(BodyNumber body) const;
  [[nodiscard]] std::size_t numBodies() const;
  /// It is one of WorldSetup::avatars: pose_t says where it is.
  [[nodiscard]] bool isAvatar(BodyNumber body) const;
  /// It is one of those that are solid.
  [[nodiscard]] bool isSolid(BodyNumber body) const;
  [[nodiscard]] WorldCounts counts() const;
  [[nodiscard]] const WorldPolicy& policy() const;

 private:
  struct Impl;
  explicit WorldSolver(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch
