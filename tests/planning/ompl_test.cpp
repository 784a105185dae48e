// <foretouch/ompl.h>: what OMPL is told is what the judge sees, on several threads as well.
#include "planning/ompl.h"

#include <cmath>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/tools/multiplan/ParallelPlan.h>
#include <ompl/util/Console.h>
#include <random>

#include <gtest/gtest.h>

#include "judge/first_touch.h"
#include "tests/middleware/edges/arm_among_wires.h"

namespace foretouch {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using test::arm;
using test::kPi;
using test::Place;
using test::wires;
using Numbers = ob::RealVectorStateSpace::StateType;

class OmplArm : public testing::Test {
 protected:
  OmplArm() {
    ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
    edges_ = useForetouch(space_, EdgeQuery::build(robot_, place_.scene).value()).value();
    space_->setup();
  }
  [[nodiscard]] double separation(const std::vector<double>& q) const {
    return test::separationOf(place_.judged, q);
  }
  [[nodiscard]] static std::vector<double> valuesOf(const ob::State* state) {
    const double* values = state->as<Numbers>()->values;
    return {values[0], values[1], values[2]};
  }

  Robot robot_ = arm(-3.0, 3.0);
  Place place_ = wires({{0.7, 0.5}, {-0.6, 0.7}, {0.1, -0.9}, {-0.9, -0.3}});
  ob::SpaceInformationPtr space_ = std::make_shared<ob::SpaceInformation>(omplSpaceOf(robot_));
  std::shared_ptr<const OmplEdges> edges_;
};

TEST(OmplEdges, PropsAreMovedBetweenPlans) {
  const Robot robot = arm(-3.0, 3.0);
  const Place far = wires({{50.0, 0.0}});
  EdgeOptions options;
  options.props = {{wires({{0.0, 0.0}}).scene, RigidPose{Quaternion::Identity(), {1, 0, 0}}, {}}};
  auto space = std::make_shared<ob::SpaceInformation>(omplSpaceOf(robot));
  auto edges = useForetouch(space, EdgeQuery::build(robot, far.scene, options).value()).value();
  space->setup();
  ob::ScopedState<ob::RealVectorStateSpace> from(space), to(space);
  for (int i = 0; i < 3; ++i) from[i] = to[i] = 0.0;
  from[0] = -0.3;
  to[0] = 0.3;
  EXPECT_FALSE(space->checkMotion(from.get(), to.get()));
  ASSERT_TRUE(edges->place(0, RigidPose{Quaternion::Identity(), {3, 0, 0}}).ok());
  EXPECT_TRUE(space->checkMotion(from.get(), to.get()));
  ASSERT_TRUE(edges->place(0, RigidPose{Quaternion::Identity(), {1, 0, 0}}).ok());
  EXPECT_FALSE(space->checkMotion(from.get(), to.get()));
  ASSERT_TRUE(edges->place(0, std::nullopt).ok());
  EXPECT_TRUE(space->checkMotion(from.get(), to.get()));
  EXPECT_EQ(edges->place(1, std::nullopt).error().code, ErrorCode::OutOfRange);
}

TEST_F(OmplArm, IsAskedAboutStatesAndMotions) {
  auto sampler = space_->allocStateSampler();
  ob::State* from = space_->allocState();
  ob::State* to = space_->allocState();
  ob::State* last = space_->allocState();
  int free = 0, stopped = 0, part = 0;
  for (int i = 0; i < 600; ++i) {
    do {
      sampler->sampleUniform(from);
    } while (!space_->isValid(from));
    EXPECT_GT(separation(valuesOf(from)), 0.0);
    sampler->sampleUniform(to);
    std::pair<ob::State*, double> where{last, -1.0};
    const auto q0 = valuesOf(from), q1 = valuesOf(to);
    const bool isFree = space_->checkMotion(from, to, where);
    EXPECT_EQ(isFree, space_->checkMotion(from, to));
    if (isFree) {
      EXPECT_EQ(where.second, -1.0);  // untouched, as OMPL has it
      where.second = 1.0;
      ++free;
    } else {
      ++stopped;
      part += where.second > 0.0 ? 1 : 0;
      EXPECT_TRUE(space_->isValid(last)) << i << " at " << where.second;
    }
    for (int k = 0; k <= 500; ++k) {
      const double t = where.second * k / 500;
      std::vector<double> q(3);
      for (std::size_t c = 0; c < 3; ++c) q[c] = q0[c] + t * (q1[c] - q0[c]);
      ASSERT_GT(separation(q), 0.0) << i << " at " << t;
    }
  }
  EXPECT_GT(free, 60);
  EXPECT_GT(stopped, 60);
  EXPECT_GT(part, 9 * stopped / 10);
  EXPECT_EQ(edges_->numEdges(), 1200U);
  for (ob::State* state : {from, to, last}) space_->freeState(state);
}

TEST_F(OmplArm, StopsAtLimits) {
  ob::State* from = space_->allocState();
  ob::State* to = space_->allocState();
  for (int i = 0; i < 3; ++i) {
    from->as<Numbers>()->values[i] = 0.0;
    to->as<Numbers>()->values[i] = i == 2 ? 6.0 : 0.0;
  }
  EXPECT_FALSE(space_->isValid(to));
  // The state that is handed back may be an end of the motion.
  std::pair<ob::State*, double> last{to, -1.0};
  EXPECT_FALSE(space_->checkMotion(from, to, last));
  EXPECT_GE(last.second, 0.0);
  EXPECT_LE(last.second, 0.5);
  EXPECT_TRUE(space_->isValid(to));
  for (ob::State* state : {from, to}) space_->freeState(state);
}

TEST_F(OmplArm, PlansOnSeveralThreads) {
  int solved = 0;
  ob::ScopedState<ob::RealVectorStateSpace> start(space_), goal(space_);
  const double a[3] = {0.0, 0.0, 0.0}, b[3] = {2.8, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) {
    start[i] = a[i];
    goal[i] = b[i];
  }
  for (int round = 0; round < 10; ++round) {
    auto problem = std::make_shared<ob::ProblemDefinition>(space_);
    problem->setStartAndGoalStates(start, goal);
    problem->setOptimizationObjective(
        std::make_shared<ob::PathLengthOptimizationObjective>(space_));
    ompl::tools::ParallelPlan plan(problem);
    for (int i = 0; i < 3; ++i) plan.addPlanner(std::make_shared<og::RRTConnect>(space_));
    if (!plan.solve(5.0, 1, 1, false)) continue;
    const auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
    ++solved;
    for (unsigned e = 0; e + 1 < path->getStateCount(); ++e) {
      const auto q0 = valuesOf(path->getState(e)), q1 = valuesOf(path->getState(e + 1));
      for (int k = 0; k <= 1000; ++k) {
        std::vector<double> q(3);
        for (std::size_t c = 0; c < 3; ++c) q[c] = q0[c] + k * 0.001 * (q1[c] - q0[c]);
        ASSERT_GT(separation(q), 0.0) << "round " << round << ", edge " << e;
      }
    }
  }
  EXPECT_GE(solved, 8);
}

TEST(OmplStates, TakeTheShorterArcOnACircle) {
  Robot limited = arm(-3.0, 3.0);
  auto joints = limited.joints();
  joints[0].kind = RobotJointKind::Continuous;
  const Robot robot = Robot::build(limited.avatar(), joints).value();
  const auto space = omplSpaceOf(robot);
  const auto states = OmplStates::of(robot, space).value();
  ob::ScopedState<> from(space), to(space), between(space);
  from[0] = 3.0;
  to[0] = -3.0;
  for (int i = 1; i < 3; ++i) from[i] = to[i] = 0.1 * i;
  std::vector<double> q0, q1;
  states.read(from.get(), q0);
  states.readEnd(q0, to.get(), q1);
  EXPECT_NEAR(q1[0], 2 * kPi - 3.0, 1e-15);
  EXPECT_EQ(q1[2], 0.2);
  space->interpolate(from.get(), to.get(), 0.25, between.get());
  EXPECT_NEAR(between[0], q0[0] + 0.25 * (q1[0] - q0[0]), 1e-14);
  states.read(to.get(), q0);
  states.readEnd(q0, from.get(), q1);
  EXPECT_NEAR(q1[0], 3.0 - 2 * kPi, 1e-15);
}

TEST(OmplStates, RefuseSpacesThatAreNotTheRobots) {
  const Robot robot = arm();
  EXPECT_EQ(OmplStates::of(robot, std::make_shared<ob::RealVectorStateSpace>(2)).error().code,
            ErrorCode::Mismatch);
  const auto se2 = OmplStates::of(robot, std::make_shared<ob::SE2StateSpace>());
  ASSERT_FALSE(se2.ok());  // its angle is on a circle
  EXPECT_EQ(se2.error().index, 2);
}

}  // namespace
}  // namespace foretouch
