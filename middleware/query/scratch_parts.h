// middleware/query/scratch_parts.h: the contents of a QueryScratch. Not installed.
#pragma once

#include <vector>

#include "articulated/motion.h"
#include "middleware/lanes/node_planes.h"
#include "middleware/lanes/pair_boxes.h"
#include "middleware/query/ignored_objects.h"
#include "middleware/query/lane_scratch.h"
#include "middleware/query/link_query.h"
#include "tessellation/axis_curve.h"

namespace foretouch::internal {

/// An LSS of the table as a curve.
struct SelfCurve {
  std::int32_t lss;
  AxisCurve curve;
};

/// Two links that left where they began, and their tolerance since.
struct LeftPair {
  LinkId link, other;
  double tolerance;
};

/// Memory of queries about own links.
struct SelfScratch {
  std::vector<NodeFrame> frames;
  std::vector<float> accelerations;  // per frame, per LSS; negative: not known yet
  MeetingPairs meeting;
  std::vector<PlanePair> pairs;                        // that planes have left open
  std::vector<AxisBounds> boundsOfOne, boundsOfOther;  // per LSS of both links of a pair
  std::vector<SelfCurve> curves;                       // of LSS of these, as far as needed
  std::vector<LeftPair> left;
};

/// Memory that one thread's queries reuse.
struct ScratchParts {
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
  SelfScratch self;

  /// Another motion is asked from now on: nothing of the last one counts. It outlives the question.
  void beginStep(const ChainMotion& motion) {
    evaluator.reset(motion);
    lanes.beginStep();
  }
};

}  // namespace foretouch::internal
