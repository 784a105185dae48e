// tools/stream/answer_tracker.h: which answers of a stream did not arrive, by what those that did
// say.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "network/wire/messages.h"

namespace foretouch::tools {

/// A service answers each pose that it accepts and says in each answer which pose it answered
/// before: what is missing in between was lost on the way to the listener. The first answer of a
/// timeline names none before it, so one that is lost right before it is not seen.
class AnswerTracker {
 public:
  /// A sentence for people where answers are missing before this one.
  [[nodiscard]] std::optional<std::string> take(const ContactsMessage& message);

  /// How often answers were missing: at least one each time.
  [[nodiscard]] std::int64_t gaps() const { return gaps_; }

 private:
  struct Last {
    std::int64_t session = 0, sequence = 0;
  };
  std::map<std::int32_t, Last> last_;  // by avatar; bounded by kMaxAvatars
  std::int64_t gaps_ = 0;
};

}  // namespace foretouch::tools
