// network/stream/bound_stream.h: one avatar's stream, bound to the sender that speaks for it
// (network/stream/speaker_gate.h). What other senders say does not reach the solver, and is not
// recorded: so a recorded stream repeats the answers without knowing who sent what. Where another
// sender takes over, the record says so, and a replay calls StreamSolver::changeSpeaker() there.
//
// The last skeletons of the speaker and of two other senders are kept, so that a sender that says
// its skeleton once is understood when it takes over. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "network/stream/speaker_gate.h"
#include "network/stream/stream_solver.h"
#include "network/wire/codec.h"
#include "network/wire/wire.h"

namespace foretouch {

/// A session may begin later than its first message arrives by at most this (us): clocks differ.
/// One beyond would be the last one for ever.
inline constexpr std::int64_t kMostSessionAheadUs = 86'400'000'000;
/// Refused poses and skeletons that changed nothing, recorded per avatar and second; those beyond
/// are counted only, so that garbage does not fill a disk.
inline constexpr int kMostRefusedRecords = 10;
/// Larger skeletons are not kept for a takeover.
inline constexpr std::size_t kMostKeptSkeletonBytes = std::size_t{1} << 20;

/// FutureSession for a session that lies too far ahead; else None.
[[nodiscard]] Reject sessionFault(std::int64_t session, std::int64_t receiveUtimeUs);

/// What a replay needs, in this order, but for the answers.
class StreamRecord {
 public:
  virtual ~StreamRecord() = default;
  virtual void speaker(const SpeakerMessage& message) = 0;
  virtual void skeleton(ByteView payload, std::int64_t receiveUtimeUs) = 0;
  virtual void pose(ByteView payload, std::int64_t receiveUtimeUs) = 0;
  /// A refused message that a replay does not need was left out.
  virtual void leftOut() = 0;
};

/// A message as it came.
struct Heard {
  UdpmSender sender;
  std::int64_t receiveUtimeUs = 0;
  ByteView payload;
};

class BoundStream {
 public:
  BoundStream(StreamSolver solver, const SpeakerPolicy& policy);

  /// As StreamSolver::take(); OtherSender for what another sender says. Records what reached the
  /// solver.
  [[nodiscard]] Reject take(const Heard& heard, const SkeletonMessage& message,
                            StreamRecord& record);
  [[nodiscard]] Reject take(const Heard& heard, const PoseMessage& message, ContactsMessage& answer,
                            StreamRecord& record);

  /// Whether a pose of this sender has any chance now. From any thread.
  [[nodiscard]] bool mayPass(const UdpmSender& sender, std::int64_t receiveUtimeUs) const {
    return gate_->mayPass(sender, receiveUtimeUs);
  }
  /// Hashes of the skeletons whose poses may be accepted now. Changes with skeletons and takeovers.
  void listKnownHashes(std::vector<std::int64_t>& hashes) const;
  [[nodiscard]] const StreamSolver& solver() const { return solver_; }
  /// As StreamSolver's.
  [[nodiscard]] SolidStream* solid() { return solver_.solid(); }

 private:
  /// The last skeleton of a sender; empty: none.
  struct Said {
    UdpmSender sender;
    std::int64_t hash = 0, receiveUtimeUs = 0;
    Bytes payload;
  };
  void keep(const Heard& heard, std::int64_t hash);
  [[nodiscard]] Said* saidBy(const UdpmSender& sender, std::int64_t hash);
  [[nodiscard]] bool isKnown(std::int64_t hash) const;
  void bringIn(const Heard& heard, const PoseMessage& message, StreamRecord& record);
  void tellSpeaker(StreamRecord& record);
  [[nodiscard]] bool isRecorded(Reject reject, std::int64_t receiveUtimeUs, StreamRecord& record);

  StreamSolver solver_;
  std::unique_ptr<SpeakerGate> gate_;  // has atomics, which do not move
  std::array<Said, 3> said_;
  std::optional<SpeakerMessage> nextSpeaker_;  // a change that is not recorded yet
  std::int64_t recordSecond_ = 0;
  int refusedRecords_ = 0;  // of this second
};

}  // namespace foretouch
