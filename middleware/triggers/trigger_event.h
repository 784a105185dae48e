// middleware/triggers/trigger_event.h: what triggers report: what enters, what leaves, and what is
// inside. World time in microseconds. The promise: docs/guarantees.md 19.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/events/world_event.h"

namespace foretouch {

/// In the order in which they were added.
using TriggerId = std::int32_t;

/// A body is inside if a point of its volume is in the trigger's, as far as is known: see
/// TriggerEvent::time.
struct TriggerEvent {
  EventKind kind = EventKind::Enter;
  TriggerId trigger = 0;
  BodyId body = 0;
  /// Which link enters or leaves, also where the body counts as one; kEveryLink: none by itself.
  LinkId link = kEveryLink;
  /// Sound: a body that is inside, at any instant, is reported so, or as unresolved: its Enter is
  /// never late, its Leave never early. Tight: a body reported inside is inside, but for twice the
  /// world's tolerance, and enters from within once of it.
  WorldTime time;
  WorldTime since;         ///< For Leave and UnresolvedTo: when what ends here began. Else `time`.
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

/// A body or link that is inside, or may be.
struct Occupant {
  TriggerId trigger = 0;
  BodyId body = 0;
  LinkId link = kEveryLink;   ///< Where the trigger counts by link; else kEveryLink.
  bool isUnresolved = false;  ///< Nothing is known of whether it is inside.
  WorldTime since;
};

struct TriggerCounters {
  std::uint64_t pairs = 0;    ///< Pairs of a trigger and a link that were asked about.
  std::uint64_t decided = 0;  ///< Times that a link and a closed mesh were asked, at one instant,
                              ///< whether it is inside.
};

struct TriggerEvents {
  /// Earliest first; at one instant: ends, begins, then ends of what began there; then by trigger.
  std::vector<TriggerEvent> events;
  TriggerCounters counters;
};

}  // namespace foretouch
