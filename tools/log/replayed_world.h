// tools/log/replayed_world.h: what a log told a service's moving world, told again in its order;
// what the world answers is compared with what the log has, byte for byte.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "network/log/event_log.h"
#include "network/world_stream/world_solver.h"
#include "tools/log/journal_check.h"
#include "tools/settings/channel_names.h"

namespace foretouch::tools {

/// Takes answers in their order; its stamps are 0.
using EventsSink = std::function<void(const EventsMessage&)>;

class ReplayedWorld {
 public:
  explicit ReplayedWorld(WorldSolver solver, EventsSink sink = nullptr)
      : solver_(std::move(solver)), sink_(std::move(sink)) {}

  /// Whether the log has answers, for which those of the replay wait.
  void compare(bool hasRecord) { compares_ = hasRecord; }
  /// An event about bodies, or a recorded answer; no other changes anything.
  void take(const LogEvent& event, const ChannelNames& channels);
  /// The step that an accepted pose of an avatar ended.
  void take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs);
  /// Another sender speaks of a body that is no avatar.
  void changeSpeaker(BodyNumber body) { solver_.changeSpeaker(body); }
  /// The log was cut off.
  void endIsOpen() { journal_.endIsOpen(); }

  [[nodiscard]] const JournalCheck& journal() const { return journal_; }
  [[nodiscard]] WorldCounts counts() const { return solver_.counts(); }
  [[nodiscard]] std::int64_t answers() const { return numAnswers_; }
  /// In the log: of bodies, or answers.
  [[nodiscard]] std::int64_t unreadable() const { return unreadable_; }
  [[nodiscard]] bool agrees() const {
    return unreadable_ == 0 && (!journal_.hasRecord() || journal_.isEqual());
  }

 private:
  template <typename Message>
  void tell(const LogEvent& event, Message& message);
  void advance();

  WorldSolver solver_;
  EventsSink sink_;
  bool compares_ = false;
  JournalCheck journal_{AnswerKind::Events};
  std::int64_t numAnswers_ = 0, unreadable_ = 0;
  BodyMessage body_;
  RigidPoseMessage rigid_;
  EventsMessage recorded_;
  std::vector<EventsMessage> answers_;
  Bytes payload_;
};

}  // namespace foretouch::tools
