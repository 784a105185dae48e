// middleware/pair/query_memory.h: what queries keep in a Scratch. Not installed.
#pragma once

#include <vector>

#include "articulated/motion.h"
#include "middleware/lanes/node_planes.h"
#include "middleware/lanes/pair_boxes.h"
#include "middleware/pair/ignored_objects.h"
#include "middleware/pair/lane_scratch.h"
#include "middleware/pair/link_query.h"
#include "middleware/scratch.h"
#include "tessellation/axis_curve.h"

namespace foretouch::internal {

/// An LSS of a table as a curve.
struct KnownCurve {
  std::int32_t lss;
  AxisCurve curve;
};

/// Two links that left where they began, and their tolerance since.
struct LeftPair {
  LinkId link, other;
  double tolerance;
};

/// What is known of one side of a pair. For own links, accelerations and curves of both are the
/// first side's.
struct SideScratch {
  std::vector<float> accelerations;  // per frame, per LSS; negative: not known yet
  std::vector<AxisBounds> bounds;    // per LSS of the current link
  std::vector<KnownCurve> curves;    // of its LSS, as far as needed
  SweptBoxes boxes;                  // for two bodies, in the current slab
  NodeEnds ends;
};

/// Memory of queries about pairs of which both sides move.
struct PairScratch {
  SideScratch one, other;
  std::vector<NodeFrame> frames;
  std::vector<LssBox> boxes;  // of the first body, for the sweep against the second
  MeetingPairs meeting;
  std::vector<PlanePair> pairs;  // that planes have left open
  std::vector<LeftPair> left;
};

/// Memory that one thread's queries reuse.
struct QueryMemory : ScratchPart {
  static constexpr ScratchKind kKind = ScratchKind::Query;

  std::vector<std::vector<LinkState>> nodes;  // per piece boundary, per link
  std::vector<AxisBounds> axisBounds;         // per LSS of the current link
  std::vector<Aabb> startBoxes;               // per LSS of the current link, at t = 0
  std::vector<Aabb> boxes;                    // per LSS of the current link, per piece
  std::vector<TriangleId> found;
  std::vector<Candidate> candidates;
  std::vector<LinkId> cutShort;  // whose share of the work was spent
  std::vector<Candidate> pairs;  // in doubles: the candidates before any was looked at
  MotionEvaluator evaluator;
  std::vector<LinkState> states;  // per link, at one instant
  LaneScratch lanes;
  IgnoredObjects ignored;  // of the current link
  PairScratch pair;
  MotionEvaluator otherEvaluator;  // of the other body's chain, where there are two
  SlabCache otherSlabs;

  /// Another motion is asked from now on: nothing of the last one counts. It outlives the question.
  void beginStep(const ChainMotion& motion) {
    evaluator.reset(motion);
    lanes.beginStep();
  }
  /// The same for two bodies, which may be on one chain.
  void beginStep(const ChainMotion& one, const ChainMotion& other) {
    beginStep(one);
    if (&one == &other) return;
    otherEvaluator.reset(other);
    otherSlabs.beginStep();
  }
};

}  // namespace foretouch::internal
