// tools/touches/touch.h: a touch: what one link does with one object, or with another own link,
// from its first contact to where it ends, over all steps (docs/concepts.md, "Touches").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/skeleton.h"

namespace foretouch::tools {

/// What touches what. Objects of one name count as one, because results name them only.
struct TouchPair {
  LinkId link = 0;
  LinkId other = -1;   ///< The own link that takes the place of the scene; -1: none.
  std::string object;  ///< The object's name, or the other link's.
};

struct Touch : TouchPair {
  /// False: it begins with a contact within a step. True: it was there at the pose at which it is
  /// known first.
  bool beginsInside = false;
  /// False: the pose after it is known to be free of it. True: nothing is known of what follows.
  bool isOpen = false;
  bool isMissed = false;  ///< A check of the poses alone sees nothing of it.
  bool isGround = false;  ///< Each of its contacts is one with the ground.
  /// Seconds on the clock of the steps: the first and the last instant at which contact is known;
  /// for those that were followed, from enter to leave.
  double beginS = 0.0, endS = 0.0;
  std::int64_t beginUs = 0, endUs = 0;       ///< For streams: the same, microseconds since 1970.
  std::int64_t firstStep = 0, lastStep = 0;  ///< For streams: sequences of the later poses.
  std::int64_t contacts = 0;                 ///< Those of the steps' answers that it is made of.
  double separation = 0.0;                   ///< Their smallest (m).
  double penetration = 0.0;                  ///< The deepest (m); 0 if it is not known.
  bool startsAtAPose = false;                ///< One of them starts a step in contact.
};

/// The order of lists: by begin, then link, object, other link.
[[nodiscard]] bool isListedBefore(const Touch& x, const Touch& y);

struct TouchCounts {
  std::int64_t touches = 0;  ///< With the scene; not with the ground.
  std::int64_t missed = 0;   ///< Of these touches.
  std::int64_t ground = 0;
  std::int64_t own = 0;  ///< With own links.

  void add(const Touch& touch);
};

}  // namespace foretouch::tools
