#include <cmath>

#include "middleware/world/world_contacts.h"

namespace foretouch {

WorldTime worldTimeAt(std::int64_t beginUs, std::int64_t endUs, double t) {
  if (t >= 1.0) return {endUs, 0.0};
  // The product may have been rounded up, by half a unit in its last place.
  const double after = std::nextafter(t * static_cast<double>(endUs - beginUs), 0.0);
  const double whole = std::floor(after);
  return {beginUs + static_cast<std::int64_t>(whole), after - whole};
}

WorldTime justAfter(const WorldTime& time) {
  const double fraction = std::nextafter(time.fraction, 1.0);
  if (fraction >= 1.0) return {time.us + 1, 0.0};
  return {time.us, fraction};
}

}  // namespace foretouch
