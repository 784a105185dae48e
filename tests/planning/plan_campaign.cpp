#include "tests/planning/plan_campaign.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <stdexcept>

#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"
#include "planning/ompl.h"

namespace foretouch::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ob::PlannerPtr plannerOf(const std::string& name, const ob::SpaceInformationPtr& space) {
  if (name == "RRTConnect") return std::make_shared<og::RRTConnect>(space);
  if (name == "PRM") return std::make_shared<og::PRM>(space);
  if (name == "BITstar") {
    const auto planner = std::make_shared<og::BITstar>(space);
    planner->setStopOnSolnImprovement(true);  // the first way, as the others
    return planner;
  }
  throw std::invalid_argument("expected RRTConnect, PRM or BITstar, found " + name);
}

ob::ScopedState<> stateOf(const ob::SpaceInformationPtr& space, const std::vector<double>& q) {
  ob::ScopedState<> state(space);
  for (std::size_t i = 0; i < q.size(); ++i) state[static_cast<unsigned>(i)] = q[i];
  return state;
}

/// What the judge says of a path; the edges as OMPL's space goes.
oracle::TouchOutcome judged(const PlanJudge& judge, const OmplStates& states,
                            const og::PathGeometric& path) {
  auto worst = oracle::TouchOutcome::Free;
  for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
    std::vector<double> q0, q1;
    states.read(path.getState(static_cast<unsigned>(i)), q0);
    states.readEnd(q0, path.getState(static_cast<unsigned>(i + 1)), q1);
    const auto found = judge.firstTouch(q0, q1).outcome;
    if (found == oracle::TouchOutcome::Touch) return found;
    if (found == oracle::TouchOutcome::Uncertain) worst = found;
  }
  return worst;
}

}  // namespace

double computedSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<PlanProblem> edgesBetween(const PlanStage& stage, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 0.5);
  Scratch scratch;
  std::vector<PlanProblem> edges;
  while (edges.size() < static_cast<std::size_t>(count)) {
    const auto q0 = stage.drawFree(random, scratch);
    auto q1 = stage.draw(random);
    const double s = share(random);
    for (std::size_t c = 0; c < q1.size(); ++c) q1[c] = q0[c] + s * (q1[c] - q0[c]);
    if (stage.edges->answer(q1, q1, scratch).value().isUsable()) edges.push_back({q0, q1});
  }
  return edges;
}

std::string PlanMethod::name() const {
  if (resolution == 0.0) return "proven";
  std::string percent = std::to_string(100.0 * resolution);
  percent.erase(percent.find_last_not_of('0') + 1);
  if (percent.back() == '.') percent.pop_back();
  return percent + " %";
}

void PlanTally::add(const PlanTally& other) {
  problems += other.problems;
  solved += other.solved;
  colliding += other.colliding;
  uncertain += other.uncertain;
  seconds.insert(seconds.end(), other.seconds.begin(), other.seconds.end());
}

std::vector<PlanProblem> planProblems(const PlanStage& stage, int count, unsigned seed) {
  std::mt19937_64 random(seed);
  Scratch scratch;
  std::vector<PlanProblem> problems;
  for (int i = 0; i < count; ++i) {
    problems.push_back({stage.drawFree(random, scratch), stage.drawFree(random, scratch)});
  }
  return problems;
}

PlanTally runPlans(const PlanStage& stage, const PlanJudge& judge,
                   const std::vector<PlanProblem>& problems, const PlanMethod& method,
                   const PlanAsked& asked) {
  PlanTally tally;
  for (const PlanProblem& problem : problems) {
    ++tally.problems;
    const auto space = std::make_shared<ob::SpaceInformation>(omplSpaceOf(stage.edges->robot()));
    const auto used = useForetouch(space, *stage.edges);
    if (!used.ok()) throw std::runtime_error(describe(used.error()));
    if (method.resolution > 0.0) {
      space->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(space));
      space->setStateValidityCheckingResolution(method.resolution);
    }
    space->setup();
    const auto definition = std::make_shared<ob::ProblemDefinition>(space);
    definition->setStartAndGoalStates(stateOf(space, problem.start), stateOf(space, problem.goal));
    const auto planner = plannerOf(asked.planner, space);
    planner->setProblemDefinition(definition);
    planner->setup();
    const auto start = Clock::now();
    const auto end =
        ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(asked.limitS),
                                          ob::exactSolnPlannerTerminationCondition(definition));
    planner->solve(end);
    if (!definition->hasExactSolution()) continue;
    auto path = *definition->getSolutionPath()->as<og::PathGeometric>();
    og::PathSimplifier(space).simplify(path, asked.simplifyS);
    tally.seconds.push_back(secondsSince(start));
    ++tally.solved;
    const auto states = OmplStates::of(stage.edges->robot(), space->getStateSpace()).value();
    const auto outcome = judged(judge, states, path);
    tally.colliding += outcome == oracle::TouchOutcome::Touch ? 1 : 0;
    tally.uncertain += outcome == oracle::TouchOutcome::Uncertain ? 1 : 0;
  }
  return tally;
}

EdgeTally runEdges(const PlanStage& stage, const PlanJudge& judge, int count, int judged,
                   unsigned seed) {
  const auto problems = edgesBetween(stage, count, seed);
  const std::size_t n = stage.edges->robot().numCoordinates();
  std::vector<double> q0, q1;
  for (const PlanProblem& problem : problems) {
    q0.insert(q0.end(), problem.start.begin(), problem.start.end());
    q1.insert(q1.end(), problem.goal.begin(), problem.goal.end());
  }
  std::vector<EdgeAnswer> answers;
  double best[2] = {1e9, 1e9}, computed = 1e9;
  WorkerPool pools[2] = {WorkerPool::start(1).value(), WorkerPool::start(2).value()};
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 2; ++i) {
      const auto start = Clock::now();
      const double startComputed = computedSeconds();
      if (!stage.edges->answerAll(q0.data(), q1.data(), problems.size(), pools[i], answers).ok()) {
        throw std::runtime_error("edges refused");
      }
      best[i] = std::min(best[i], secondsSince(start));
      if (i == 0) computed = std::min(computed, computedSeconds() - startComputed);
    }
  }
  EdgeTally tally;
  tally.edges = count;
  tally.meanUs = 1e6 * computed / std::max(1, count);
  tally.twoThreads = best[0] / best[1];
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const bool isClear = answers[i].verdict == Verdict::Clear;
    tally.clear += isClear ? 1 : 0;
    if (i >= static_cast<std::size_t>(judged)) continue;
    const auto touch = judge.firstTouch(problems[i].start, problems[i].goal);
    if (touch.outcome == oracle::TouchOutcome::Uncertain) {
      ++tally.uncertain;
    } else if (touch.outcome == oracle::TouchOutcome::Touch) {
      tally.missed += isClear ? 1 : 0;
      tally.late += !isClear && answers[i].freeUntil > touch.t ? 1 : 0;
    }
    if (isClear) continue;
    std::vector<double> q(n);
    for (std::size_t c = 0; c < n; ++c) {
      q[c] = problems[i].start[c] +
             answers[i].freeUntil * (problems[i].goal[c] - problems[i].start[c]);
    }
    tally.early += judge.separationAt(q, 1.0) > 1.01 * kDefaultTolerance ? 1 : 0;
  }
  return tally;
}

}  // namespace foretouch::test
