// middleware/pair/lane_scratch.h: what a lane query (lane_query.h) keeps between queries. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "articulated/chain_nodes.h"
#include "middleware/lanes/lss_pairs.h"
#include "middleware/lanes/near_triangles.h"
#include "middleware/pair/leaf_hits.h"
#include "middleware/pair/part_pairs.h"
#include "middleware/query_options.h"
#include "middleware/scene/flat_bvh.h"
#include "tessellation/lss_polynomials.h"
#include "tessellation/node_ends.h"
#include "tessellation/swept_boxes.h"

namespace foretouch::internal {

/// What is known of one span of the motion that is asked.
struct SlabScratch {
  ChainNodes nodes;
  bool areNodesOfStep = false;
  SweptBoxes boxes;
  NodeEnds ends;                 // with `boxes`, where own links are asked
  bool areBoxesOfNodes = false;  // of the avatar's own LSS, all of them
  std::uint64_t lastUse = 0;
};

/// The spans of one motion that were looked at last.
class SlabCache {
 public:
  /// Another motion is asked from now on.
  void beginStep() {
    for (SlabScratch& slab : slabs_) slab.areNodesOfStep = slab.areBoxesOfNodes = false;
  }
  /// The span that evaluateNodes() was called for last.
  [[nodiscard]] SlabScratch& slab() { return slabs_[current_]; }
  [[nodiscard]] const SlabScratch& slab() const { return slabs_[current_]; }
  [[nodiscard]] const ChainNodes& nodes() const { return slab().nodes; }
  [[nodiscard]] const SweptBoxes& boxes() const { return slab().boxes; }

  /// Goes to a span of the motion that is asked, and finds its nodes unless they are there.
  /// `beside`: another chain, whose places are compared with these; or null.
  void evaluateNodes(const ChainMotion& motion, double begin, double end,
                     const Eigen::Vector3d& origin, QueryCounters& counters,
                     const ChainMotion* beside = nullptr) {
    current_ = slabFor(begin, end);
    SlabScratch& here = slab();
    here.lastUse = ++uses_;
    if (here.areNodesOfStep && here.nodes.begin() == begin && here.nodes.end() == end) return;
    here.nodes.evaluate(motion, begin, end, origin, beside);
    here.areNodesOfStep = true;
    here.areBoxesOfNodes = false;
    counters.states +=
        static_cast<std::uint64_t>(kNodes) * static_cast<std::uint64_t>(motion.numLinks());
  }

 private:
  /// The whole motion, its halves, and its thirds.
  static constexpr std::size_t kSlabsKept = 6;

  /// The place that has the span, in this step or in an earlier one, whose instants it keeps; else
  /// the one that has been idle for longest.
  [[nodiscard]] std::size_t slabFor(double begin, double end) const {
    std::size_t idle = 0;
    for (std::size_t i = 0; i < kSlabsKept; ++i) {
      const ChainNodes& nodes = slabs_[i].nodes;
      if (nodes.begin() == begin && nodes.end() == end) return i;
      if (slabs_[i].lastUse < slabs_[idle].lastUse) idle = i;
    }
    return idle;
  }

  std::array<SlabScratch, kSlabsKept> slabs_;
  std::size_t current_ = 0;
  std::uint64_t uses_ = 0;
};

/// The hits are those of the LSS' boxes.
struct LaneScratch : LeafHits, SlabCache {
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
};

}  // namespace foretouch::internal
