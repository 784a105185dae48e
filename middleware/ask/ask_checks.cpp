#include "middleware/ask/ask_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "articulated/skeleton.h"
#include "articulated/track.h"

namespace foretouch::internal {
namespace {

Error shapeError(ErrorCode code, const char* message) {
  return Error::in("shape", code, message);
}

}  // namespace

Result<Done> checkedShape(const Lss& shape) {
  if (!shape.a.allFinite() || !shape.b.allFinite() || !std::isfinite(shape.radius)) {
    return shapeError(ErrorCode::NonFinite, "expected finite coordinates and a finite radius");
  }
  const double most = std::max(shape.a.cwiseAbs().maxCoeff(), shape.b.cwiseAbs().maxCoeff());
  if (most > kMaxCoordinate) {
    return shapeError(ErrorCode::OutOfRange, "expected coordinates within 1e7 m");
  }
  if (shape.radius >= 0.0 && shape.radius <= kMaxCoordinate) return Done{};
  return shapeError(ErrorCode::OutOfRange, "expected a radius from 0 to 1e7 m");
}

Result<Done> checkedTime(const WorldParts& world, const WorldTime& time, const char* where) {
  if (!(time.fraction >= 0.0 && time.fraction < 1.0)) {
    return Error::in(where, ErrorCode::OutOfRange,
                     "expected a fraction of a microsecond in [0, 1)");
  }
  if (time.us < -kMostUtimeUs || time.us > kMostUtimeUs) {
    return Error::in(where, ErrorCode::OutOfRange, "expected an instant within 2^53 us of zero");
  }
  if (time.us >= world.forgottenUs) return Done{};
  return Error::in(where, ErrorCode::OutOfRange,
                   "all before " + std::to_string(world.forgottenUs) +
                       " us is forgotten; expected a later instant, found " +
                       std::to_string(time.us) + " us");
}

}  // namespace foretouch::internal
