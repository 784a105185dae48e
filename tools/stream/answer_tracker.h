// tools/stream/answer_tracker.h: finds the answers of a stream that did not arrive, from those that
// did.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "network/wire/messages.h"

namespace foretouch::tools {

/// A service answers each pose that it accepts, and each answer names the pose answered before: a
/// missing answer in between was lost on the way to the listener. The first answer of a timeline
/// names no pose before it, so it does not reveal one lost right before it.
class AnswerTracker {
 public:
  /// A sentence for people if answers are missing before this one.
  [[nodiscard]] std::optional<std::string> take(const ContactsMessage& message);

  /// How often at least one answer was missing.
  [[nodiscard]] std::int64_t gaps() const { return gaps_; }

 private:
  struct Last {
    std::int64_t session = 0, sequence = 0;
  };
  std::map<std::int32_t, Last> last_;  // by avatar; bounded by kMaxAvatars
  std::int64_t gaps_ = 0;
};

}  // namespace foretouch::tools
