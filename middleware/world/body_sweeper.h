// middleware/world/body_sweeper.h: makes what is known of each body by itself in a window: where it
// is, and what it meets of the static scene and of its own links. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/result.h"
#include "middleware/world/body_sweep.h"
#include "middleware/world/system_query.h"
#include "middleware/world/world_contacts.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// One window of world time; `number` is different for every window that a scratch is asked about.
struct Window {
  std::int64_t fromUs, toUs;
  std::uint64_t number;
  Eigen::Vector3d origin;  ///< Near the bodies, so that floats resolve them.
  /// What met before it, in a motion that it is part of, is reported from its begin on, and not
  /// asked again.
  bool isFollowed = false;
};

/// For one thread and one window. What it refers to outlives it.
class BodySweeper {
 public:
  BodySweeper(const WorldParts& world, SystemPlans& plans, const Window& window,
              SystemScratch& scratch)
      : world_(world), window_(window), scratch_(scratch), query_(world, plans, scratch) {}

  /// Brings `sweep` to the window, and appends the body's own contacts in it to `found`. What
  /// `sweep` has from earlier windows serves again, with the same answers. Errors: as
  /// SystemPlans::planOf().
  Result<Done> sweep(BodyId body, BodySweep& sweep, std::vector<WorldContact>& found,
                     WorldCounters& counters);

  /// For a rigid body that is not carried, and that is far from the static scene or not asked about
  /// it: a box around all ways in which it could turn, and nothing else. False: another body, or
  /// it is carried. O(1) per span, and a descent into the scene: a tenth of what sweep()
  /// takes.
  [[nodiscard]] bool sweepRoughly(BodyId body, BodySweep& sweep);

 private:
  [[nodiscard]] SystemQuestion questionOf(BodyId body) const;
  [[nodiscard]] bool isFarFromScene(const TrackPiece& piece, double rho) const;
  [[nodiscard]] BodyBox boxAround(const TrackPiece& piece, double reach) const;
  Result<Done> fill(BodyId body, SystemQuestion question, SpanSweep& span);
  Result<Done> keepOwn(BodyId body, SystemQuestion question, const SpanPart& part,
                       const SpanSweep& span, std::size_t first, std::vector<WorldContact>& found,
                       WorldCounters& counters);
  Result<Done> askAgain(BodyId body, SystemQuestion question, const SpanPart& part,
                        const SpanSweep& span, std::size_t first, std::vector<WorldContact>& found,
                        WorldCounters& counters);

  const WorldParts& world_;
  const Window& window_;
  SystemScratch& scratch_;
  SystemQuery query_;
};

}  // namespace foretouch::internal
