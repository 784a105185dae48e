// middleware/query/scratch_parts.h: what stands behind a QueryScratch. Not installed.
#pragma once

#include <vector>

#include "articulated/motion.h"
#include "middleware/ladder/rung_volumes.h"
#include "middleware/query/ignored_objects.h"
#include "middleware/query/lane_scratch.h"
#include "middleware/query/link_query.h"

namespace foretouch::internal {

/// What queries above link fidelity keep.
struct RungScratch {
  RungVolumes volumes;
  std::vector<std::vector<Lss>> perLink;  // the volumes by their carriers
  LssTable table;
  std::vector<IgnoredPair> ignored;   // of the volumes, by their carriers
  std::vector<std::uint8_t> isAsked;  // per link: not ignored altogether
  StepContacts carriers;              // what they are answered for their volumes
  std::vector<LinkContact> answers;   // of the volumes
};

/// Memory that one thread's queries reuse.
struct ScratchParts {
  std::vector<std::vector<LinkState>> nodes;  // per piece boundary, per link
  std::vector<AxisBounds> axisBounds;         // per LSS of the link at hand
  std::vector<Aabb> startBoxes;               // per LSS of the link at hand, at t = 0
  std::vector<Aabb> boxes;                    // per LSS of the link at hand, per piece
  std::vector<TriangleId> found;
  std::vector<Candidate> candidates;
  MotionEvaluator evaluator;
  LaneScratch lanes;
  IgnoredObjects ignored;  // of the link at hand
  RungScratch rungs;
};

}  // namespace foretouch::internal
