// middleware/near/near_plan.h: a near query, checked (near_features.h), and its memory. Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/motion.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/near/near_blocks.h"
#include "middleware/near/near_features.h"
#include "middleware/near/near_reduction.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/leaf_hits.h"
#include "middleware/scratch.h"

namespace foretouch::internal {

struct NearPlan {
  Avatar avatar;
  Scene scene;
  std::vector<IgnoredPair> ignored;
  const FlatEdges* flat;  // the scene's
};

struct NearMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Near;

  ChainMotion still;                      // that of a pose that is asked
  std::vector<LinkState> states;          // at it
  std::vector<double> reach;              // the same for all
  std::vector<StandingLss> lss;           // asked
  std::vector<float> lower[3], upper[3];  // of their boxes, from the tree's origin
  LeafHits hits;
  NearTriangles near;
  NearBlocks blocks;
  IgnoredObjects ignored;
  NearReduction reduction;
  std::vector<NearPlace> found;  // of the current link
};

}  // namespace foretouch::internal
