// A sample of the campaign of plans, its judge's kinematics, and that it sees what sampling misses.
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <gtest/gtest.h>

#include "tests/middleware/edges/arm_among_wires.h"
#include "tests/planning/plan_campaign.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

PlanStage stageOf(const std::string& robot, const std::string& scene) {
  const auto shared = sharedRobot(robot);
  return planStage(scene, shared->value(), 3).value();
}

TEST(PlanJudge, FindsTheTouchThatAnArcSineFinds) {
  const Robot robot = arm();
  const Triangle wire{Eigen::Vector3d(-1, 0, -1), Eigen::Vector3d(-1, 0, 1),
                      Eigen::Vector3d(-1.0 + 1e-12, 0, 1)};
  const PlanJudge judge(robot, {wire}, {});
  const auto touch = judge.firstTouch({0.5, 0, 0}, {2 * kPi - 0.5, 0, 0});
  ASSERT_EQ(touch.outcome, oracle::TouchOutcome::Touch);
  EXPECT_NEAR(0.5 + touch.t * (2 * kPi - 1.0), kPi - std::asin(0.03), 1e-6);
  EXPECT_EQ(judge.firstTouch({0.5, 0, 0}, {2.5, 0, 0}).outcome, oracle::TouchOutcome::Free);
  EXPECT_EQ(PlanJudge(robot, {wire}, {0, 1, 2}).firstTouch({0.5, 0, 0}, {4, 0, 0}).outcome,
            oracle::TouchOutcome::Free);
}

TEST(PlanCampaign, NoProvenPlanCollidesAndCoarselySampledOnesDo) {
  FORETOUCH_REQUIRE_SHARED(urdf, "robots/franka_panda/panda.urdf");
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const PlanStage stage = stageOf("panda", "wires-10");
  const PlanJudge judge(stage.edges->robot(), stage.triangles, stage.left);
  const auto problems = planProblems(stage, 8, 5);
  const PlanAsked asked{"RRTConnect", 5.0, 0.5};
  const auto proven = runPlans(stage, judge, problems, {0.0}, asked);
  EXPECT_GE(proven.solved, 5);
  EXPECT_EQ(proven.colliding, 0);
  const auto sampled = runPlans(stage, judge, problems, {0.05}, asked);
  EXPECT_GE(sampled.solved, 5);
  EXPECT_GT(sampled.colliding, 0);
}

TEST(PlanCampaign, EdgesAreNeverMissedNorLateNorEarly) {
  FORETOUCH_REQUIRE_SHARED(urdf, "robots/kuka_iiwa/model.urdf");
  const PlanStage stage = stageOf("iiwa", "wires-4");
  const PlanJudge judge(stage.edges->robot(), stage.triangles, stage.left);
  const auto tally = runEdges(stage, judge, 200, 200, 7);
  EXPECT_GT(tally.clear, 10);
  EXPECT_LT(tally.clear, 190);
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.late, 0);
  EXPECT_EQ(tally.early, 0);
  EXPECT_LT(tally.uncertain, 5);
}

}  // namespace
}  // namespace foretouch::test
