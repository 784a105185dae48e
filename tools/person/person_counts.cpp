#include "tools/person/person_counts.h"

#include <fmt/format.h>

namespace foretouch::tools {

void PersonCounts::add(BracketVerdict verdict, std::int64_t steps) {
  intervals += steps;
  switch (verdict) {
    case BracketVerdict::Unclaimed: unclaimed += steps; break;
    case BracketVerdict::Excluded: excluded += steps; break;
    case BracketVerdict::Possible: possible += steps; break;
    case BracketVerdict::Certain: certain += steps; break;
  }
}

void PersonCounts::addExcluded(std::int64_t more) {
  intervals += more;
  excluded += more;
}

std::string PersonCounts::brokenNote(const std::string& link) const {
  if (broken == 0) return "";
  return fmt::format(
      "The clip breaks its bounds at {} of the poses that were left out, link by link: {} at "
      "{:.3f} s by {:.1f} mm. What is said of the person there does not hold.",
      broken, link, worstS, 1e3 * worstM);
}

}  // namespace foretouch::tools
