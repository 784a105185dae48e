// middleware/triggers/presence.h: what one, or several together, do in a trigger through a stretch
// of world time: stretches of being inside, of not being known, and in between of being outside.
// Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "middleware/world/world_contacts.h"

namespace foretouch::internal {

/// Later ones win where several say something at one time.
enum class Presence : std::uint8_t { Outside, Unresolved, Inside };

/// Closed, but for what comes next.
struct PresenceSpan {
  WorldTime from, to;
  Presence presence = Presence::Inside;
  LinkId link = 0;
  bool isAssumed = false;
  /// It begins where one of the two is known first: no touch was seen.
  bool isFirstKnown = false;
};

/// The spans of several, in any order, as one's: by time, none overlapping or touching one of its
/// kind; each with the link that made it begin. `spans` is replaced. O(n log n).
void unite(std::vector<PresenceSpan>& spans, std::vector<PresenceSpan>& memory);

}  // namespace foretouch::internal
