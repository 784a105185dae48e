// Plans an arm's way among poles by OMPL's RRTConnect on edges that Foretouch proves, and prints
// it: plan_arm ROBOT.urdf [SEED]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <foretouch/ompl.h>
#include <iostream>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <utility>
#include <vector>

namespace ob = ompl::base;
namespace og = ompl::geometric;
using namespace foretouch;

template <typename T>
T orStop(Result<T> result) {
  if (!result.ok()) {
    std::cerr << describe(result.error()) << '\n';
    std::exit(1);
  }
  return std::move(result).value();
}

/// Eight flat poles, 4 mm wide, around the robot's base; +Z up, as in its URDF.
Scene poles() {
  RawScene raw;
  raw.objectNames = {"poles"};
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.785 * i + 0.4, x = 0.55 * std::cos(angle), y = 0.55 * std::sin(angle);
    const Eigen::Vector3d across(-0.004 * std::sin(angle), 0.004 * std::cos(angle), 0.0);
    const Eigen::Vector3d low(x, y, -0.2), high(x, y, 1.5);
    raw.triangles.push_back({{low, low + across, high}});
    raw.triangles.push_back({{low + across, high + across, high}});
    raw.objectOf.insert(raw.objectOf.end(), 2, 0);
  }
  return orStop(Scene::build(std::move(raw)));
}

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: plan_arm ROBOT.urdf [SEED]\n";
    return 2;
  }
  ompl::RNG::setSeed(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const Robot robot = orStop(importRobot(argv[1])).made.robot;
  EdgeOptions options;
  options.clearance = 0.005;
  const EdgeQuery edges = orStop(EdgeQuery::build(robot, poles(), options));

  auto space = std::make_shared<ob::SpaceInformation>(omplSpaceOf(robot));
  const auto asked = orStop(useForetouch(space, edges));
  space->setup();

  // Two free configurations.
  const OmplStates states = orStop(OmplStates::of(robot, space->getStateSpace()));
  og::SimpleSetup setup(space);
  ob::ScopedState<> start(space), goal(space);
  for (auto* state : {&start, &goal}) {
    do {
      state->random();
    } while (!space->isValid(state->get()));
  }
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<og::RRTConnect>(space));
  if (!setup.solve(20.0) || !setup.haveExactSolutionPath()) {
    std::cerr << "no way found\n";
    return 1;
  }
  setup.simplifySolution(1.0);

  // The last word: the path as it is, asked once more.
  std::vector<double> path, q;
  for (const ob::State* state : setup.getSolutionPath().getStates()) {
    states.read(state, q);
    for (const double value : q) std::printf("%.6f ", value);
    std::printf("\n");
    path.insert(path.end(), q.begin(), q.end());
  }
  EdgePool pool = orStop(EdgePool::start(1));
  const std::size_t count = path.size() / robot.numCoordinates();
  const PathAnswer answer = orStop(pool.answerPath(edges, path.data(), count));
  const bool isFree = answer.edge == count - 1;
  std::printf("%zu configurations, %llu edges asked; keeps 5 mm: %s\n", count,
              static_cast<unsigned long long>(asked->numEdges()), isFree ? "proven" : "no");
  return isFree ? 0 : 1;
}
