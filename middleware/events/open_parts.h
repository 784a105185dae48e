// middleware/events/open_parts.h: what has begun and not ended, and the parts of time that follow
// from events. Not installed.
#pragma once

#include <vector>

#include "middleware/events/pair_key.h"
#include "middleware/events/world_event.h"

namespace foretouch::internal {

/// Keeps its memory.
class OpenParts {
 public:
  /// By key.
  [[nodiscard]] const std::vector<OpenPart>& all() const { return open_; }
  [[nodiscard]] bool has(const PairKey& key) const;

  /// Time is followed from here on.
  void beginTime(std::int64_t fromUs);
  /// Takes in an event, and appends the part that it ends. Events of one pair come in order.
  void take(const WorldEvent& event, std::vector<WorldPart>& parts);
  /// What is open there rests on a motion that is assumed.
  void assume(const PairKey& key);
  /// Time is followed until here: appends the parts that go on, and sorts all by pair and time.
  void endTime(std::int64_t toUs, std::vector<WorldPart>& parts);

 private:
  [[nodiscard]] std::size_t placeOf(const PairKey& key) const;
  void close(std::size_t place, const WorldTime& to, bool goesOn,
             std::vector<WorldPart>& parts) const;

  std::vector<OpenPart> open_;
  WorldTime from_;
};

}  // namespace foretouch::internal
