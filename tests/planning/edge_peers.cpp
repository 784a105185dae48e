// tests/planning/edge_peers.cpp: edges per second of Foretouch beside those of FCL, sampled and
// continuous, and how many contacts each misses by the judge; and lists of edges on several threads
// (./run edges). Exit code 0: Foretouch
// missed nothing; 1: it did; 2: bad use; 77: no shared data.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"
#include "tests/planning/edge_solver.h"
#include "tests/planning/plan_campaign.h"

namespace {

using namespace foretouch;
using namespace foretouch::test;

class ProvenEdges : public EdgeSolver {
 public:
  explicit ProvenEdges(const PlanStage& stage)
      : EdgeSolver("Foretouch, proven"), edges_(*stage.edges) {}
  bool touches(const std::vector<double>& q0, const std::vector<double>& q1) override {
    return edges_.answer(q0, q1, scratch_).value().verdict != Verdict::Clear;
  }

 private:
  const EdgeQuery& edges_;
  Scratch scratch_;
};

struct Arguments {
  std::vector<std::string> robots{"panda", "iiwa"},
      scenes{"wires-20", "wires-10", "wires-4", "shelf", "office", "kitchen"};
  std::vector<double> percents{5, 1, 0.5, 0.1};
  std::vector<int> samples{10, 100};
  int edges = 1000, threads = 2;
  unsigned seed = 1;
};

/// All edges as one list: wall clock seconds, the least of a few passes.
class ListTimes {
 public:
  explicit ListTimes(int threads)
      : one_(WorkerPool::start(1).value()), several_(WorkerPool::start(threads).value()) {}
  void add(const EdgeQuery& edges, const std::vector<PlanProblem>& problems) {
    std::vector<double> q0, q1;
    for (const PlanProblem& problem : problems) {
      q0.insert(q0.end(), problem.start.begin(), problem.start.end());
      q1.insert(q1.end(), problem.goal.begin(), problem.goal.end());
    }
    constexpr int kPasses = 5;
    double least[2] = {1e9, 1e9};
    for (int pass = 0; pass < kPasses; ++pass) {
      for (const bool isOne : {true, false}) {
        const auto begin = std::chrono::steady_clock::now();
        WorkerPool& pool = isOne ? one_ : several_;
        (void)edges.answerAll(q0.data(), q1.data(), problems.size(), pool, answers_).value();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        least[isOne ? 0 : 1] = std::min(least[isOne ? 0 : 1], took.count());
      }
    }
    for (const int i : {0, 1}) seconds_[i] += least[i];
    count_ += problems.size();
  }
  void print() const {
    const auto count = static_cast<double>(count_);
    std::printf("\nas lists: %.2f us an edge on 1 thread, %.2f on %d: %.2f times as fast\n",
                1e6 * seconds_[0] / count, 1e6 * seconds_[1] / count, several_.threads(),
                seconds_[0] / seconds_[1]);
  }

 private:
  WorkerPool one_, several_;
  std::vector<EdgeAnswer> answers_;
  double seconds_[2] = {};
  std::size_t count_ = 0;
};

struct Tally {
  std::string name;
  int edges = 0, clear = 0, judged = 0, touching = 0;
  int missed = 0;        ///< Called clear, and touches.
  int metUntouched = 0;  ///< Called a contact, and nothing touches: Foretouch has a tolerance.
  double seconds = 0.0;
};

/// One robot in one scene; adds to the sums, one per solver.
void runStage(const Arguments& a, const std::string& robot, const PlanStage& stage,
              std::vector<Tally>& sums, ListTimes& lists) {
  EdgeSolvers solvers;
  solvers.push_back(std::make_unique<ProvenEdges>(stage));
  std::vector<double> shares;
  for (const double percent : a.percents) shares.push_back(percent / 100.0);
  for (auto& solver : fclEdgeSolvers(stage, shares, a.samples)) {
    solvers.push_back(std::move(solver));
  }
  const PlanJudge judge(stage.edges->robot(), stage.triangles, stage.left);
  const auto edges = edgesBetween(stage, a.edges, a.seed);
  lists.add(*stage.edges, edges);
  std::vector<oracle::FirstTouch> truth;
  for (const PlanProblem& edge : edges) truth.push_back(judge.firstTouch(edge.start, edge.goal));
  sums.resize(solvers.size());
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    Tally t;
    t.name = solvers[s]->name();
    std::vector<bool> found;
    const double start = computedSeconds();
    for (const PlanProblem& edge : edges) {
      found.push_back(solvers[s]->touches(edge.start, edge.goal));
    }
    t.seconds = computedSeconds() - start;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      ++t.edges;
      t.clear += found[i] ? 0 : 1;
      if (truth[i].outcome == oracle::TouchOutcome::Uncertain) continue;
      const bool isTouch = truth[i].outcome == oracle::TouchOutcome::Touch;
      ++t.judged;
      t.touching += isTouch ? 1 : 0;
      t.missed += isTouch && !found[i] ? 1 : 0;
      t.metUntouched += !isTouch && found[i] ? 1 : 0;
    }
    std::printf("%-6s %-9s %-32s %6d edges %6d touch %5d missed %5d met untouched %9.2f us\n",
                robot.c_str(), stage.name.c_str(), t.name.c_str(), t.edges, t.touching, t.missed,
                t.metUntouched, 1e6 * t.seconds / std::max(1, t.edges));
    std::fflush(stdout);
    Tally& sum = sums[s];
    sum.name = t.name;
    sum.edges += t.edges;
    sum.judged += t.judged;
    sum.touching += t.touching;
    sum.missed += t.missed;
    sum.metUntouched += t.metUntouched;
    sum.seconds += t.seconds;
  }
}

void printTable(const std::vector<Tally>& sums) {
  std::printf(
      "\n| solver | edges a second | us an edge | of %d contacts, missed | met untouched |\n"
      "|---|---|---|---|---|\n",
      sums.front().touching);
  for (const Tally& t : sums) {
    std::printf("| %s | %.0f | %.2f | %d (%.1f %%) | %d |\n", t.name.c_str(), t.edges / t.seconds,
                1e6 * t.seconds / t.edges, t.missed, 100.0 * t.missed / std::max(1, t.touching),
                t.metUntouched);
  }
}

int run(const Arguments& a) {
  std::vector<Tally> sums;
  ListTimes lists(a.threads);
  for (const std::string& name : a.robots) {
    const auto robot = sharedRobot(name);
    if (!robot) {
      std::cerr << "left out: " << name << " (no shared data)\n";
      continue;
    }
    if (!robot->ok()) throw std::runtime_error(describe(robot->error()));
    for (const std::string& scene : a.scenes) {
      const auto stage = planStage(scene, robot->value(), a.seed);
      if (!stage) {
        std::cerr << "left out: " << scene << " (no shared data)\n";
        continue;
      }
      runStage(a, name, *stage, sums, lists);
    }
  }
  if (sums.empty()) return 77;
  printTable(sums);
  lists.print();
  std::puts(
      "\nUntouched: nothing touches by the judge; Foretouch comes within its tolerance, 1 mm.");
  return sums.front().missed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Edges of planners: Foretouch beside FCL, judged");
  app.add_option("--robots", a.robots, "panda, iiwa")->delimiter(',');
  app.add_option("--scenes", a.scenes, "wires-MM, shelf, office, kitchen")->delimiter(',');
  app.add_option("--percents", a.percents, "Resolutions of the sampled ones")->delimiter(',');
  app.add_option("--samples", a.samples, "Of FCL's continuousCollide()")->delimiter(',');
  app.add_option("--edges", a.edges, "Random edges per robot and scene");
  app.add_option("--threads", a.threads, "Of a list of edges, beside one")
      ->check(CLI::Range(1, kMaxPoolThreads));
  app.add_option("--seed", a.seed, "Of scenes and edges");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(a);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
