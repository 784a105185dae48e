// bench/solid/busy_places.h: places where a clip goes through furniture now and then, found by the
// judge alone.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/solid/stage.h"

namespace foretouch::tools {

struct BusyPlace {
  Placement placement;
  double fromS = 0.0;   ///< Since the clip's begin.
  double inside = 0.0;  ///< Share of the probed frames in which the body is inside something.
};

struct BusyPlaceRequest {
  int count = 1;
  double seconds = 4.0;  ///< Length of the clip's part, from a random instant on.
  std::uint64_t seed = 1;
  double leastInside = 0.15, mostInside = 0.6;
  int mostDraws = 2000;
};

/// The first pose at each place is free. Drawn over the scene's ground plan, half of them onto its
/// lowest surface there, the others onto any; the same for the same request. There may be fewer.
[[nodiscard]] std::vector<BusyPlace> busyPlaces(const SolidStage& stage, const SolidActor& actor,
                                                const BusyPlaceRequest& request);

}  // namespace foretouch::tools
