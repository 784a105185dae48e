// tools/stream/stream_touches.h: the answers of a stream as touches.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "network/wire/messages.h"
#include "tools/touches/touch_tracker.h"

namespace foretouch::tools {

/// A touch with the names of a stream. Its steps are the sequences of the poses that end them.
struct StreamTouch {
  Touch touch;
  std::int32_t avatar = 0;
  std::int64_t session = 0;
  std::string linkName;
};

/// What an answer begins and ends, in its order.
struct TouchEvents {
  std::vector<StreamTouch> begun;  ///< As far as known: their first contact.
  std::vector<StreamTouch> ended;
};

/// The touches of one avatar. Bounded memory, whatever arrives.
class StreamTouches {
 public:
  /// Answers as they come: where one is missing, lost poses are between two, or a timeline begins,
  /// what was open ends as open. `onGround`: for each contact of the message; empty: for none.
  void take(const ContactsMessage& message, const std::vector<bool>& onGround, TouchEvents& events);
  /// Call when nothing follows.
  void breakOff(TouchEvents& events);

 private:
  void addRows(const ContactsMessage& message, const std::vector<bool>& onGround);
  [[nodiscard]] StreamTouch named(Touch touch) const;

  TouchTracker tracker_{TouchScope::FirstOfLink};
  std::int32_t avatar_ = 0;
  std::int64_t session_ = 0;  // of the last answer
  std::optional<std::int64_t> sequence_;
  std::map<LinkId, std::string> names_;  // of links that have touched
  // For the answer that is being taken.
  TouchStep step_;
  std::vector<Touch> ended_;
  std::vector<std::size_t> begun_;
};

}  // namespace foretouch::tools
