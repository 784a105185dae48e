// ray_yardstick.h of a library that was built without Embree.
#include "middleware/scene/ray_yardstick.h"

namespace foretouch {

bool canCastRays() {
  return false;
}

Result<int> castRaySet(const Scene& /*scene*/,
                       const std::array<RaySegment, kRaysPerSet>& /*rays*/) {
  return Error::of(ErrorCode::DeviceFailed,
                   "expected a library with Embree, whose rays these are; this one has none");
}

}  // namespace foretouch
