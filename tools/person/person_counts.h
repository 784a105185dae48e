// tools/person/person_counts.h: how many links and steps have which verdict, and how far a clip
// breaks what is claimed of its person.
#pragma once

#include <cstdint>
#include <string>

#include "articulated/skeleton.h"
#include "middleware/bracket/bracket.h"

namespace foretouch::tools {

struct PersonCounts {
  std::int64_t intervals = 0;  ///< Links that have LSS, times steps.
  std::int64_t excluded = 0, possible = 0, certain = 0, unclaimed = 0;
  std::int64_t inGaps = 0;  ///< Of the intervals: the clip has gaps there, and only speeds count.
  std::int64_t broken = 0;  ///< Frames, link by link, at which the clip breaks the bound.
  LinkId worstLink = 0;     ///< The one that breaks it most: when, and by how much (m).
  double worstS = 0.0, worstM = 0.0;

  void add(BracketVerdict verdict, std::int64_t steps = 1);
  void addExcluded(std::int64_t more);
  /// A note for people if any is broken, else empty; `link`: the worst link's name.
  [[nodiscard]] std::string brokenNote(const std::string& link) const;
};

}  // namespace foretouch::tools
