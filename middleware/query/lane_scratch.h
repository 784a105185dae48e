// middleware/query/lane_scratch.h: what a lane query (lane_query.h) keeps between queries. Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/chain_nodes.h"
#include "middleware/lanes/lss_pairs.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/query/lane_backtracking.h"
#include "middleware/query_options.h"
#include "middleware/scene/flat_bvh.h"
#include "tessellation/lss_polynomials.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

struct LaneScratch {
  ChainNodes nodes;
  bool areNodesOfStep = false;  // of the motion that is asked, in the span that they name
  SweptBoxes boxes;
  bool areBoxesOfNodes = false;  // of the avatar's own LSS, all of them
  std::vector<LeafHit> hits;     // of all LSS, in the order of the walk
  // The hits by LSS; `first`: where those of an LSS begin.
  std::vector<std::uint32_t> first;
  std::vector<std::int32_t> leaf;  // padded by kMaxLanes
  std::vector<std::uint8_t> triangles;
  PairLanes pairs;
  std::vector<LeafPart> leafParts;    // of the current LSS
  std::vector<std::uint32_t> order;   // of the clusters, by time
  HandedOver clusters, handed;        // of the current LSS
  NearTriangles near;                 // of the current LSS, where its link is in contact
  PartScratch parts;                  // of the current link, at exact fidelity
  std::vector<std::uint8_t> isAsked;  // per link: not ignored, not answered yet
  std::vector<std::uint8_t> isNear;  // per link, at skinned fidelity: asked, and its box met a leaf
  std::vector<double> tolerances;    // per link that passes its start: its own; else 0
  std::vector<IgnoredPair> touched;  // objects that have had their contact (Scope::EveryObject)
  std::vector<double> freeUntil;     // per link, if work is limited: how far it is proven free

  /// The nodes of a span of the motion that is asked, unless they are there.
  void evaluateNodes(const ChainMotion& motion, double begin, double end,
                     const Eigen::Vector3d& origin, QueryCounters& counters) {
    if (areNodesOfStep && nodes.begin() == begin && nodes.end() == end) return;
    nodes.evaluate(motion, begin, end, origin);
    areNodesOfStep = true;
    areBoxesOfNodes = false;
    counters.states +=
        static_cast<std::uint64_t>(kNodes) * static_cast<std::uint64_t>(motion.numLinks());
  }
};

}  // namespace foretouch::internal
