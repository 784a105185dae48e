// tests/network/simulated_sender.h: a sender of poses with its true motion, its clock, its tracking
// and its mistakes; everything that it sends, drawn from a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "tests/network/simulated_world.h"

namespace foretouch::test {

/// Probabilities, per pose unless stated otherwise.
struct SenderFaults {
  double unmatched = 0.0;                  ///< Per joint: the sender's skeleton lacks it.
  double trackingLost = 0;                 ///< Per joint, for some poses.
  double fewJoints = 0.0;                  ///< Per sender: never lists some of its joints.
  double badContent = 0.0;                 ///< A pose that breaks the rules.
  double restart = 0.0, noSessions = 0.0;  ///< The latter: per sender.
  double clockJump = 0.0, oddStamp = 0.0, pause = 0.0;
  double lateSkeleton = 0.0;  ///< Per sender.
  double changedSkeleton = 0.0;
  double stops = 0.0;  ///< Per sender, for good.
};

/// Identifies a true pose of a simulation.
struct PoseId {
  int sender = -1, life = 0, index = 0;

  friend bool operator<(const PoseId& x, const PoseId& y) {
    return std::tie(x.sender, x.life, x.index) < std::tie(y.sender, y.life, y.index);
  }
};

struct SentMessage {
  std::int64_t timeUs = 0;  ///< Of the simulation, not of the sender's clock.
  bool isSkeleton = false;
  Bytes payload;
  PoseId id;  ///< Of a pose.
};

struct SimulatedSender {
  std::int32_t avatar = 0;  ///< As in messages.
  bool hasSessions = true;
  /// From start to restart: every true pose of the body, including those never sent. A step of the
  /// truth is between neighbours.
  std::vector<std::vector<Pose>> lives;
  std::vector<SentMessage> sent;
};

struct SenderSetup {
  int sender = 0;
  std::int32_t avatar = 0;
  bool mayLackSessions = true;
  bool unmatchedAtRest = false;  ///< The truth about joints that the sender lacks.
};

[[nodiscard]] SimulatedSender randomSender(Random& random, const SimulatedBody& body,
                                           const SenderSetup& setup, const SenderFaults& faults);

}  // namespace foretouch::test
