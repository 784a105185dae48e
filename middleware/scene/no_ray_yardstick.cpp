// castRaySet() of a library that was built without Embree.
#include "middleware/scene/ray_yardstick.h"

namespace foretouch {

Result<int> castRaySet(const Scene& /*scene*/,
                       const std::array<RaySegment, kRaysPerSet>& /*rays*/) {
  return Error::of(ErrorCode::DeviceFailed,
                   "expected a library with Embree, whose rays these are; this one has none");
}

}  // namespace foretouch
