// middleware/events/followed_bodies.h: what a follower knows of two bodies from window to window:
// which of their links are in contact, and what it has found of the motion that they are in. Not
// installed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "middleware/events/interval_tracer.h"
#include "middleware/events/span_sides.h"
#include "middleware/events/world_event.h"
#include "middleware/world/work_shares.h"

namespace foretouch::internal {

/// Two links, or a link and an object of a mesh or of the scene.
struct FollowedSides {
  LinkPair links;
  ObjectId object = kNoObject;
  WorldTime from;  ///< Free before it, if nothing is open.
  bool isOpen = false;
  PartKind kind = PartKind::Contact;  ///< That of what is open, as the next two.
  UndecidedReason reason = UndecidedReason::None;
  WorldTime since;
  SidesPair witness;  ///< The pair that held them together last.
  /// The rest of the motion is known. What begins and ends in it, and is not reported yet, is in
  /// FollowedBodies::parts, from the first to the second place.
  bool isTraced = false;
  std::size_t nextPart = 0, endPart = 0;
  bool startsInside = false;  ///< The next part begins where it was not looked at before.
  bool isMoved = false;       ///< The next part ends where it began: one was put elsewhere there.

  [[nodiscard]] bool isPending() const { return nextPart < endPart; }
};

/// Keeps its memory. The motion is that of a span between two poses of the bodies and their
/// carriers: it does not depend on the windows that use parts of it.
struct FollowedBodies {
  BodyPair bodies;
  std::int64_t beginUs = 0, endUs = 0;  ///< The motion's; none is known if they are equal.
  /// Its members, and since when each is carried as it is: a change may be told of later.
  std::vector<std::pair<BodyId, std::int64_t>> members;
  std::vector<FollowedSides> sides;
  std::vector<StepPart> parts;
  /// Links whose near objects, for the rest of the motion, are among the sides.
  std::vector<LinkPair> collected;
  /// All sides are traced, and nothing is to be reported before it.
  std::int64_t nextUs = std::numeric_limits<std::int64_t>::min();

  /// Whether there is something to report of them, sooner or later, that no window lists.
  [[nodiscard]] bool isActive() const {
    return std::any_of(sides.begin(), sides.end(),
                       [](const FollowedSides& side) { return side.isOpen || side.isPending(); });
  }
  void forgetMotion() {
    beginUs = endUs = 0;
    nextUs = std::numeric_limits<std::int64_t>::min();
    parts.clear();
    collected.clear();
    for (FollowedSides& side : sides) {
      side.isTraced = side.startsInside = side.isMoved = false;
      side.nextPart = side.endPart = 0;
    }
  }
  /// As if they had never been looked at.
  void clear() {
    sides.clear();
    forgetMotion();
  }
};

/// Two links that may come near each other from the instant on.
struct ListedPair {
  BodyPair bodies;
  LinkPair links;
  WorldTime time;
};
/// Two bodies in a window.
struct TracedBodies {
  FollowedBodies* followed = nullptr;
  std::size_t first = 0, count = 0;  ///< Theirs in TraceWindow::listed.
  std::uint64_t work = 0;            ///< What they may cost; with too little they are not traced.
  /// Doubles do not resolve where they are, by the question, from there to the window's end.
  std::int64_t lostUs = std::numeric_limits<std::int64_t>::max();

  [[nodiscard]] bool isGivenUp() const { return work < kSpanWork; }
};

}  // namespace foretouch::internal
