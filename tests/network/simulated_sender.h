// tests/network/simulated_sender.h: a sender of poses with its true motion, its clock, its tracking
// and its mistakes; all that it sends in its life, drawn from a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "tests/network/simulated_world.h"

namespace foretouch::test {

/// Chances, a pose or as it says.
struct SenderFaults {
  double unmatched = 0.0;                  ///< A joint that the sender's skeleton lacks.
  double trackingLost = 0;                 ///< A joint, for some poses.
  double fewJoints = 0.0;                  ///< A sender that never lists some of its joints.
  double badContent = 0.0;                 ///< A pose that is against the rules.
  double restart = 0.0, noSessions = 0.0;  ///< The latter: a sender.
  double clockJump = 0.0, oddStamp = 0.0, pause = 0.0;
  double lateSkeleton = 0.0;  ///< A sender.
  double changedSkeleton = 0.0;
  double stops = 0.0;  ///< A sender, for good.
};

/// Which of all true poses of a simulation.
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
  std::int32_t avatar = 0;  ///< As messages call it.
  bool hasSessions = true;
  /// From start to restart: every pose of the body as it truly was, those that were never sent
  /// among them. A step of the truth is one between neighbours.
  std::vector<std::vector<Pose>> lives;
  std::vector<SentMessage> sent;
};

struct SenderSetup {
  int sender = 0;
  std::int32_t avatar = 0;
  bool mayLackSessions = true;
  bool unmatchedAtRest = false;  ///< The truth of joints that the sender lacks.
};

[[nodiscard]] SimulatedSender randomSender(Random& random, const SimulatedBody& body,
                                           const SenderSetup& setup, const SenderFaults& faults);

}  // namespace foretouch::test
