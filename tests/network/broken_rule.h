// tests/network/broken_rule.h: a receiver with one rule broken: what it hears is changed so that a
// correct solver does what a broken one would.
#pragma once

#include <cstdint>
#include <set>

#include "network/stream/stream_solver.h"
#include "network/wire/messages.h"
#include "network/wire/reject.h"
#include "tests/network/simulated_sender.h"
#include "tests/network/stream/stream_simulation.h"

namespace foretouch::test {

class BrokenRule {
 public:
  explicit BrokenRule(Mutation mutation) : mutation_(mutation) {}

  /// As solver.take(), with `message` changed into what was taken. `numJoints`: of the sender's
  /// skeleton.
  [[nodiscard]] Reject take(StreamSolver& solver, const PoseId& id, std::int32_t numJoints,
                            PoseMessage& message, ContactsMessage& answer);

 private:
  void changeJoints(std::int32_t numJoints, PoseMessage& message) const;
  void changePlace(const PoseId& id, PoseMessage& message);
  void changeAnswer(ContactsMessage& answer) const;

  Mutation mutation_;
  bool hasLast_ = false;
  std::int64_t saidSession_ = 0, saidSequence_ = 0;  // as it came
  PoseMessage last_;                                 // as it was taken
  std::set<PoseId> taken_;
};

}  // namespace foretouch::test
