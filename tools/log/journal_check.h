// tools/log/journal_check.h: are the answers of a replay equal to those that a log recorded, byte
// for byte?
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/messages.h"
#include "network/wire/world_messages.h"

namespace foretouch::tools {

/// The kind of the answers that are compared.
enum class AnswerKind : std::uint8_t { Contacts, Solid, Person, Events, Pushes };

/// Compares verdictBytes() by avatar, session and sequence, for events by timeline and sequence;
/// several answers to one sequence (a sender without sessions) in their order. Keeps answers
/// without a counterpart so far.
class JournalCheck {
 public:
  explicit JournalCheck(AnswerKind kind = AnswerKind::Contacts) : kind_(kind) {}

  /// Adds an answer from the log. `message` is the decoded `payload`.
  template <typename Message>
  void addRecorded(const Message& message, ByteView payload) {
    addRecorded(keyOf(message), payload);
  }
  /// Adds an answer of the replay.
  template <typename Message>
  void addReplayed(const Message& message, ByteView payload) {
    addReplayed(keyOf(message), payload);
  }

  /// The log was cut off: each avatar's replayed answers after its last recorded one are not
  /// missing, but beyond the log's end. Call after all answers are added.
  void endIsOpen();

  /// False if the log has no answer to compare with.
  [[nodiscard]] bool hasRecord() const { return recorded_ > 0; }
  [[nodiscard]] std::int64_t recorded() const { return recorded_; }
  [[nodiscard]] std::int64_t equal() const { return equal_; }
  /// Answers of the replay beyond the log's end.
  [[nodiscard]] std::int64_t beyondEnd() const { return beyondEnd_; }
  /// All recorded answers are replayed and equal, and all replayed ones are recorded.
  [[nodiscard]] bool isEqual() const {
    return !first_ && recordedOnly_.empty() && replayedOnly_.empty();
  }
  /// The first difference, in the order of the log, as a sentence; nothing if isEqual().
  [[nodiscard]] std::optional<std::string> firstDifference() const;

 private:
  using Key = std::tuple<std::int32_t, std::int64_t, std::int64_t>;
  struct Waiting {
    std::int64_t order = 0;
    Bytes payload;
  };
  using Queues = std::map<Key, std::deque<Waiting>>;
  struct Difference {
    std::int64_t order = 0;
    std::string text;
  };

  [[nodiscard]] static Key keyOf(const ContactsMessage& message) {
    return {message.avatar, message.session, message.sequenceTo};
  }
  [[nodiscard]] static Key keyOf(const EventsMessage& message) {
    return {0, message.timeline, message.sequence};
  }
  template <typename Message>
  [[nodiscard]] static Key keyOf(const Message& message) {
    return {message.avatar, message.session, message.sequence};
  }

  /// Takes the counterpart of an answer out of `others`, or leaves the answer in `own`.
  std::optional<Bytes> pair(const Key& key, ByteView payload, Queues& own, Queues& others);
  void addRecorded(const Key& key, ByteView payload);
  void addReplayed(const Key& key, ByteView payload);
  void compare(const Key& key, ByteView recorded, ByteView replayed);
  [[nodiscard]] std::string differenceOf(ByteView recorded, ByteView replayed) const;
  [[nodiscard]] std::optional<Difference> firstOf(const Queues& queues, const char* what) const;
  [[nodiscard]] std::string nameOf(const Key& key) const;

  AnswerKind kind_;
  Queues recordedOnly_, replayedOnly_;
  std::optional<Difference> first_;
  std::map<std::int32_t, std::int64_t> lastRecorded_;  // by avatar: the order
  std::int64_t recorded_ = 0, equal_ = 0, beyondEnd_ = 0, order_ = 0;
};

}  // namespace foretouch::tools
