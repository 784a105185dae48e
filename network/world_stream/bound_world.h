// network/world_stream/bound_world.h: a live world whose bodies are bound to the sender that speaks
// for them (network/stream/speaker_gate.h), each for itself: what others say of it does not reach
// the solver, and is not recorded. So a recorded stream repeats the answers without knowing who
// sent what. Avatars are bound by their own streams.
//
// A sender may have as many bodies as there are places left. So none takes all of them: the first
// one leaves half, the next one a quarter, and so on. Not installed.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "network/stream/bound_stream.h"
#include "network/stream/speaker_gate.h"
#include "network/wire/codec.h"
#include "network/world_stream/world_solver.h"

namespace foretouch {

/// What a replay needs of a world, in this order, but for the answers.
class WorldRecord {
 public:
  virtual ~WorldRecord() = default;
  virtual void speaker(const SpeakerMessage& message) = 0;
  virtual void body(ByteView payload, std::int64_t receiveUtimeUs) = 0;
  virtual void rigidPose(ByteView payload, std::int64_t receiveUtimeUs) = 0;
};

class BoundWorld {
 public:
  BoundWorld(WorldSolver solver, const SpeakerPolicy& policy)
      : solver_(std::move(solver)), policy_(policy) {}

  /// As WorldSolver's; OtherSender for what another sender says. Records what was accepted.
  [[nodiscard]] Reject take(const Heard& heard, const BodyMessage& message, WorldRecord& record);
  /// Takes out of `message` what another sender may not say; what is recorded lacks it, too.
  /// Records what was accepted, or noted (WorldSolver::isNoted()).
  [[nodiscard]] Reject take(const Heard& heard, RigidPoseMessage& message, WorldRecord& record);

  [[nodiscard]] WorldSolver& solver() { return solver_; }
  [[nodiscard]] const WorldSolver& solver() const { return solver_; }

 private:
  [[nodiscard]] bool hasRoomFor(const UdpmSender& sender) const;
  [[nodiscard]] bool mayPass(const Heard& heard, BodyNumber body, WorldRecord& record);
  SpeakerGate& gateOf(BodyNumber body);

  WorldSolver solver_;
  SpeakerPolicy policy_;
  std::map<BodyNumber, std::unique_ptr<SpeakerGate>> gates_;  // has atomics, which do not move
  Bytes payload_;
};

}  // namespace foretouch
