// middleware/world/body_boxes.h: where each body is in a window: float boxes around all that it
// sweeps, as a whole, per LSS, and per span between its knots. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "middleware/world/body_system.h"
#include "middleware/world/box_sweep.h"
#include "middleware/world/system_plan.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// Of one body; relative to the window's origin, grown by half the world's tolerance and more.
struct BodySweep {
  struct Span {
    std::int64_t beginUs, endUs;
    BodyBox box;
  };
  BodyBox whole;
  std::vector<Span> spans;
  std::array<std::vector<float>, 3> lower, upper;  // per LSS, over the whole window

  /// Some LSS of this body and some of the other have boxes that meet.
  [[nodiscard]] bool isNear(const BodySweep& other) const;
  /// The boxes of some spans that lie in [beginUs, endUs) meet.
  [[nodiscard]] bool isNearIn(const BodySweep& other, std::int64_t beginUs,
                              std::int64_t endUs) const;

 private:
  [[nodiscard]] BodyBox boxIn(std::int64_t beginUs, std::int64_t endUs) const;
};

/// Memory for making them.
struct SweepScratch {
  SystemSpans spans;
  SystemPoses poses;
  ChainMotion motion;
  ChainNodes nodes;
  SweptBoxes boxes;
};

/// What the body sweeps in a window, as far as it is there. Errors: as SystemPlans::planOf().
[[nodiscard]] Result<Done> sweepBody(const WorldParts& world, BodyId body, std::int64_t fromUs,
                                     std::int64_t toUs, const Eigen::Vector3d& origin,
                                     SystemPlans& plans, PieceMotions& motions,
                                     SweepScratch& scratch, BodySweep& sweep);

}  // namespace foretouch::internal
