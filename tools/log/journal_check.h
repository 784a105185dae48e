// tools/log/journal_check.h: are the answers of a replay those that a log recorded, byte for
// byte?
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "network/wire/codec.h"
#include "network/wire/messages.h"

namespace foretouch::tools {

/// Compares verdictBytes() by avatar, session and sequence; of several answers to one sequence (a
/// sender that does not say its sessions), in their order. Keeps what has no counterpart yet.
class JournalCheck {
 public:
  /// An answer that the log holds. `message` is what `payload` holds.
  void addRecorded(const ContactsMessage& message, ByteView payload);
  /// An answer that the replay gives.
  void addReplayed(const ContactsMessage& message, ByteView payload);

  /// The log was cut off: of each avatar, answers of the replay after the last recorded one are not
  /// missing there, but beyond its end. To be called once all have been added.
  void endIsOpen();

  /// False while the log has given no answer: there is nothing to compare with.
  [[nodiscard]] bool hasRecord() const { return recorded_ > 0; }
  [[nodiscard]] std::int64_t recorded() const { return recorded_; }
  [[nodiscard]] std::int64_t equal() const { return equal_; }
  /// Answers of the replay beyond the log's end.
  [[nodiscard]] std::int64_t beyondEnd() const { return beyondEnd_; }
  /// All recorded answers are replayed and equal, and all replayed ones are recorded.
  [[nodiscard]] bool isEqual() const {
    return !first_ && recordedOnly_.empty() && replayedOnly_.empty();
  }
  /// What is wrong first, in the order of the log, as a sentence; nothing where isEqual().
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

  /// Takes the counterpart of an answer out of `others`, or leaves the answer in `own`.
  std::optional<Bytes> pair(const Key& key, ByteView payload, Queues& own, Queues& others);
  void compare(const ContactsMessage& message, ByteView recorded, ByteView replayed);
  [[nodiscard]] static std::optional<Difference> firstOf(const Queues& queues, const char* what);

  Queues recordedOnly_, replayedOnly_;
  std::optional<Difference> first_;
  std::map<std::int32_t, std::int64_t> lastRecorded_;  // by avatar: the order
  std::int64_t recorded_ = 0, equal_ = 0, beyondEnd_ = 0, order_ = 0;
};

}  // namespace foretouch::tools
