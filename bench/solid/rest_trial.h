// bench/solid/rest_trial.h: a tracked body that stops inside furniture, or trembles there: does the
// shown one rest? Metres.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/solid/busy_places.h"
#include "bench/solid/way_audit.h"
#include "middleware/solid/solid_options.h"

namespace foretouch::tools {

/// One number per place.
struct RestTally {
  /// The most that an end of an LSS moves in a tick, of 270 ticks with the same target: after 30 of
  /// them in a row in which neither the catch-up, nor the work budget, nor the lift held it up.
  std::vector<double> stillStep;
  std::vector<double> ticksToRest;  ///< Until nothing moves any more, of the 270.
  std::vector<double> noise;        ///< With a trembling target, 270 ticks: RMS acceleration of all
                                    ///< ends, shown by tracked.
  std::vector<double> worstEnd;     ///< The same for the end where it is largest.
  std::uint64_t queries = 0, ticks = 0;  ///< Of those ticks.
  WayTally way;
  void add(const RestTally& other);
};

/// Follows `tracked` (90 Hz) up to the middle one of those poses that the judge finds inside, and
/// stops there; then each joint trembles by 1 mrad and the root by 0.5 mm. Nothing if none is
/// inside.
[[nodiscard]] Result<RestTally> tryRest(const SolidStage& stage, const SolidActor& actor,
                                        const std::vector<Pose>& tracked,
                                        const SolidOptions& options);

}  // namespace foretouch::tools
