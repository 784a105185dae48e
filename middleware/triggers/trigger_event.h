// middleware/triggers/trigger_event.h: what triggers tell: who enters, who leaves, and who is
// inside. World time in microseconds. The promise: docs/guarantees.md 19.
#pragma once

#include <cstdint>
#include <vector>

#include "middleware/events/world_event.h"

namespace foretouch {

/// In the order in which they were added.
using TriggerId = std::int32_t;

/// A body is inside if a point of its volume is in the trigger's, as far as is known: see
/// TriggerEvent.
struct TriggerEvent {
  EventKind kind = EventKind::Enter;
  TriggerId trigger = 0;
  BodyId body = 0;
  /// Which link enters or leaves, also where the body counts as one; kEveryLink: none by itself.
  LinkId link = kEveryLink;
  /// Sound: no body is inside, at any instant, that is not reported so, or as unresolved: an Enter
  /// is never later than it is, a Leave never earlier. Tight: a body reported inside is, but for
  /// twice the world's tolerance, and enters from within once of it.
  WorldTime time;
  WorldTime since;  ///< Of Leave and UnresolvedTo: when that began which ends here. Else `time`.
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

/// Who is inside, or may be.
struct Occupant {
  TriggerId trigger = 0;
  BodyId body = 0;
  LinkId link = kEveryLink;   ///< Where the trigger counts by link; else kEveryLink.
  bool isUnresolved = false;  ///< Nothing is known of whether it is inside.
  WorldTime since;
};

struct TriggerCounters {
  std::uint64_t pairs = 0;    ///< Of a trigger and a link that were asked about.
  std::uint64_t decided = 0;  ///< Times that a link and a closed mesh were asked, at one instant,
                              ///< whether it is inside.
};

struct TriggerEvents {
  /// Earliest first; at one instant what ends before what begins, then by trigger, body and link.
  std::vector<TriggerEvent> events;
  TriggerCounters counters;
};

}  // namespace foretouch
