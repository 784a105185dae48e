// tests/network/broken_rule.h: a receiver with one rule broken: it changes messages so that a
// correct solver acts like a broken one.
#pragma once

#include <cstdint>
#include <set>

#include "network/stream/stream_solver.h"
#include "network/wire/messages.h"
#include "tests/network/simulated_sender.h"
#include "tests/network/stream/stream_simulation.h"

namespace foretouch::test {

class BrokenRule {
 public:
  explicit BrokenRule(Mutation mutation) : mutation_(mutation) {}

  /// As solver.take(), and changes `message` into the one taken. `numJoints`: of the sender's
  /// skeleton.
  [[nodiscard]] Reject take(StreamSolver& solver, const PoseId& id, std::int32_t numJoints,
                            PoseMessage& message, ContactsMessage& answer);

 private:
  void changeJoints(std::int32_t numJoints, PoseMessage& message) const;
  void changePlace(const PoseId& id, PoseMessage& message);
  void changeAnswer(ContactsMessage& answer) const;

  Mutation mutation_;
  bool hasLast_ = false;
  std::int64_t saidSession_ = 0, saidSequence_ = 0;  // as received
  PoseMessage last_;                                 // as taken
  std::set<PoseId> taken_;
};

}  // namespace foretouch::test
