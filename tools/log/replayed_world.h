// tools/log/replayed_world.h: gives a moving world again, in its order, what a log has for a
// service's; compares what the world answers with what the log has, byte for byte.
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
  /// Takes an event about bodies, or a recorded answer; other events change nothing.
  void take(const LogEvent& event, const ChannelNames& channels);
  /// Takes a recorded solid_t; false if it is not about a solid body of the world.
  [[nodiscard]] bool takeShown(const LogEvent& event);
  /// Takes the step that an accepted pose of an avatar ended.
  void take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs);
  /// Another sender speaks for a body that is not an avatar.
  void changeSpeaker(BodyNumber body) { solver_.changeSpeaker(body); }
  /// The log was cut off.
  void endIsOpen() {
    for (JournalCheck* const check : {&journal_, &solids_, &pushes_}) check->endIsOpen();
  }

  [[nodiscard]] const JournalCheck& journal() const { return journal_; }
  /// The comparisons of what solid bodies show, and of what presses against them.
  [[nodiscard]] const JournalCheck& solids() const { return solids_; }
  [[nodiscard]] const JournalCheck& pushes() const { return pushes_; }
  [[nodiscard]] WorldCounts counts() const { return solver_.counts(); }
  [[nodiscard]] std::int64_t answers() const { return numAnswers_; }
  /// The number of solid_t; there are as many pushes_t.
  [[nodiscard]] std::int64_t shown() const { return numShown_; }
  /// Unreadable events in the log: about bodies, or answers.
  [[nodiscard]] std::int64_t unreadable() const { return unreadable_; }
  [[nodiscard]] bool agrees() const {
    const auto isEqual = [](const JournalCheck& check) {
      return !check.hasRecord() || check.isEqual();
    };
    return unreadable_ == 0 && isEqual(journal_) && isEqual(solids_) && isEqual(pushes_);
  }

 private:
  template <typename Message>
  void tell(const LogEvent& event, Message& message);
  template <typename Message>
  void compare(const LogEvent& event, Message& message, JournalCheck& check);
  template <typename Message>
  void add(const Message& message, JournalCheck& check);
  void advance();

  WorldSolver solver_;
  EventsSink sink_;
  bool compares_ = false;
  JournalCheck journal_{AnswerKind::Events};
  JournalCheck solids_{AnswerKind::Solid}, pushes_{AnswerKind::Pushes};
  std::int64_t numAnswers_ = 0, numShown_ = 0, unreadable_ = 0;
  BodyMessage body_;
  RigidPoseMessage rigid_;
  EventsMessage recorded_;
  SolidMessage recordedSolid_;
  PushesMessage recordedPushes_;
  std::vector<EventsMessage> answers_;
  Bytes payload_;
};

}  // namespace foretouch::tools
