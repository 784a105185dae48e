// Plans an arm's way among poles by OMPL's RRTConnect on edges that Foretouch proves, and prints
// it: plan_arm ROBOT [SEED [FOLDER]], with a URDF or MJCF. Writes plan.csv and poles.obj to the
// folder, for `foretouch replay --report` to show (docs/robots.md).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <foretouch/foretouch.hpp>
#include <foretouch/ompl.h>
#include <fstream>
#include <iostream>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <string>
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
RawScene poles() {
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
  return raw;
}

void writeObj(const RawScene& scene, const std::string& path) {
  std::ofstream out(path);
  int vertices = 0;
  for (const Triangle& triangle : scene.triangles) {
    for (const Eigen::Vector3d& v : triangle.vertices) {
      out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    out << "f " << vertices + 1 << ' ' << vertices + 2 << ' ' << vertices + 3 << '\n';
    vertices += 3;
  }
  if (!out.flush()) std::cerr << path << ": cannot be written\n";
}

/// What every joint of the robot does on the path, at 30 rows per second and at most 0.05 rad or m
/// per row, those that follow others included: what `--motion plan.csv --robot ROBOT` takes.
void writeCsv(const Robot& robot, const std::vector<double>& path, const std::string& name) {
  const std::size_t n = robot.numCoordinates();
  std::ofstream out(name);
  out.precision(12);
  out << "time";
  for (const RobotJoint& joint : robot.joints()) {
    if (joint.kind != RobotJointKind::Fixed) out << ',' << joint.name;
  }
  out << '\n';
  int rows = 0;
  std::vector<double> q(n);
  const auto writeRow = [&] {
    std::vector<double> valueOf(robot.joints().size(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      valueOf[static_cast<std::size_t>(robot.coordinates()[i].joint)] = q[i];
    }
    out << rows++ / 30.0;
    for (std::size_t j = 0; j < valueOf.size(); ++j) {
      const RobotJoint& joint = robot.joints()[j];
      if (joint.kind == RobotJointKind::Fixed) continue;
      const auto leader = static_cast<std::size_t>(joint.mimicOf);
      out << ','
          << (joint.mimicOf < 0 ? valueOf[j]
                                : joint.mimicFactor * valueOf[leader] + joint.mimicOffset);
    }
    out << '\n';
  };
  for (std::size_t edge = 0; edge + 1 < path.size() / n; ++edge) {
    const double *from = &path[edge * n], *to = from + n;
    double farthest = 0.0;
    for (std::size_t i = 0; i < n; ++i) farthest = std::max(farthest, std::abs(to[i] - from[i]));
    const int steps = 1 + static_cast<int>(farthest / 0.05);
    for (int k = edge == 0 ? 0 : 1; k <= steps; ++k) {
      robot.between(from, to, static_cast<double>(k) / steps, q.data());
      writeRow();
    }
  }
  if (!out.flush()) std::cerr << name << ": cannot be written\n";
}

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: plan_arm ROBOT [SEED [FOLDER]]\n";
    return 2;
  }
  ompl::RNG::setSeed(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 1);
  const Robot robot = orStop(importRobot(argv[1])).made.robot;
  EdgeOptions options;
  options.clearance = 0.005;
  const Scene scene = orStop(Scene::build(poles()));
  const EdgeQuery edges = orStop(EdgeQuery::build(robot, scene, options));

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
  if (argc > 3) {
    writeObj(poles(), std::string(argv[3]) + "/poles.obj");
    writeCsv(robot, path, std::string(argv[3]) + "/plan.csv");
  }
  WorkerPool pool = orStop(WorkerPool::start(1));
  const std::size_t count = path.size() / robot.numCoordinates();
  const PathAnswer answer = orStop(edges.answerPath(path.data(), count, pool));
  const bool isFree = answer.edge == count - 1;
  std::printf("%zu configurations, %llu edges asked; keeps 5 mm: %s\n", count,
              static_cast<unsigned long long>(asked->numEdges()), isFree ? "proven" : "no");
  return isFree ? 0 : 1;
}
