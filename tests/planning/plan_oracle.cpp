// tests/planning/plan_oracle.cpp: the campaign of plan_campaign.h at any length (./run plans). Exit
// code 0: no proven plan collides and no edge's answer is wrong; 1: one does; 2: bad use or nothing
// to do.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <CLI/CLI.hpp>

#include "tests/planning/plan_campaign.h"

namespace {

using namespace foretouch;
using namespace foretouch::test;

struct Arguments {
  std::vector<std::string> robots{"panda", "iiwa"}, planners{"RRTConnect", "PRM", "BITstar"},
      scenes{"wires-20", "wires-10", "wires-4", "shelf", "office", "kitchen"};
  std::vector<double> percents{5, 1, 0.5, 0.1, 0};
  int problems = 10, edges = 2000, judged = 500;
  double limitS = 5.0;
  unsigned seed = 1;
};

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void printPlans(const char* robot, const std::string& scene, const std::string& planner,
                const std::string& method, const PlanTally& t) {
  std::printf("%-6s %-9s %-11s %-7s %5d plans %5d solved %5d collide %3d uncertain %9.2f ms\n",
              robot, scene.c_str(), planner.c_str(), method.c_str(), t.problems, t.solved,
              t.colliding, t.uncertain, 1e3 * medianOf(t.seconds));
  std::fflush(stdout);
}

/// Of all stages, by method, and by planner and method.
using Sums = std::map<std::string, PlanTally>;

/// True: all that is proven holds.
bool runStage(const Arguments& a, const std::string& name, const Robot& robot,
              const PlanStage& stage, Sums& sums) {
  const PlanJudge judge(robot, stage.triangles, stage.left);
  const EdgeTally e = runEdges(stage, judge, a.edges, std::min(a.edges, a.judged), a.seed);
  std::printf(
      "%-6s %-9s %zu triangles; edges: %d, %d clear, judged: %d missed, %d late, %d early, %d "
      "uncertain; %.2f us, two threads %.2f times\n",
      name.c_str(), stage.name.c_str(), stage.triangles.size(), e.edges, e.clear, e.missed, e.late,
      e.early, e.uncertain, e.meanUs, e.twoThreads);
  bool holds = e.missed + e.late + e.early == 0;
  const auto problems = planProblems(stage, a.problems, a.seed + 1);
  for (const std::string& planner : a.planners) {
    for (const double percent : a.percents) {
      const PlanMethod method{percent / 100.0};
      const PlanTally tally = runPlans(stage, judge, problems, method, {planner, a.limitS, 1.0});
      printPlans(name.c_str(), stage.name, planner, method.name(), tally);
      sums[method.name()].add(tally);
      sums[planner + " " + method.name()].add(tally);
      holds = holds && (percent > 0.0 || tally.colliding == 0);
    }
  }
  return holds;
}

int run(const Arguments& a) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(a.seed);
  Sums sums;
  int stages = 0;
  bool holds = true;
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
      ++stages;
      holds = runStage(a, name, robot->value(), *stage, sums) && holds;
    }
  }
  for (const auto& [method, tally] : sums) printPlans("all", "all", "", method, tally);
  if (stages == 0) return 2;
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Plans of OMPL's planners, sampled and proven, judged");
  app.add_option("--robots", a.robots, "panda, iiwa")->delimiter(',');
  app.add_option("--scenes", a.scenes, "wires-MM, shelf, office, kitchen")->delimiter(',');
  app.add_option("--planners", a.planners, "RRTConnect, PRM, BITstar")->delimiter(',');
  app.add_option("--percents", a.percents, "Resolutions; 0: proven")->delimiter(',');
  app.add_option("--problems", a.problems, "Per robot, scene, planner and resolution");
  app.add_option("--edges", a.edges, "Random edges per robot and scene");
  app.add_option("--judged", a.judged, "How many of these the judge looks at");
  app.add_option("--limit", a.limitS, "Seconds per plan");
  app.add_option("--seed", a.seed, "Of scenes, problems and planners");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(a);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
