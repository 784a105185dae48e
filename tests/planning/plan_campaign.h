// tests/planning/plan_campaign.h: plans of OMPL's planners, with sampled edges at several
// resolutions and with proven ones, and how many of them collide in truth. Both kinds ask Foretouch
// about single states, so that all see one geometry.
#pragma once

#include <string>
#include <vector>

#include "tests/planning/plan_judge.h"
#include "tests/planning/plan_stage.h"

namespace foretouch::test {

/// How edges are checked: sampled at this share of the space's extent; 0: proven.
struct PlanMethod {
  double resolution = 0.0;
  [[nodiscard]] std::string name() const;
};

struct PlanTally {
  int problems = 0, solved = 0;
  int colliding = 0, uncertain = 0;  ///< Of the returned paths, by the judge.
  std::vector<double> seconds;       ///< Of planning and simplification, one per solved problem.
  void add(const PlanTally& other);
};

struct PlanAsked {
  std::string planner;  ///< "RRTConnect", "PRM", "BITstar".
  double limitS = 5.0, simplifyS = 1.0;
};

/// From a start to a goal; the same for every method.
struct PlanProblem {
  std::vector<double> start, goal;
};
[[nodiscard]] std::vector<PlanProblem> planProblems(const PlanStage& stage, int count,
                                                    unsigned seed);
[[nodiscard]] PlanTally runPlans(const PlanStage& stage, const PlanJudge& judge,
                                 const std::vector<PlanProblem>& problems, const PlanMethod& method,
                                 const PlanAsked& asked);

/// Random edges between free states, at most half as long as from one random configuration to
/// another, asked and judged.
struct EdgeTally {
  int edges = 0, clear = 0;
  int missed = 0, late = 0;  ///< Clear but touching; freeUntil behind the first touch.
  int early = 0;             ///< In contact, but farther than the tolerance at freeUntil.
  int uncertain = 0;
  double meanUs = 0.0;      ///< Of a processor, on one thread.
  double twoThreads = 0.0;  ///< How many times as fast two threads are, by the clock.
};
/// `judged`: how many of them the judge looks at.
[[nodiscard]] EdgeTally runEdges(const PlanStage& stage, const PlanJudge& judge, int count,
                                 int judged, unsigned seed);

}  // namespace foretouch::test
