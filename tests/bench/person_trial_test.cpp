// Brackets judged on the bundled dancer, of whom most poses are held back: nothing is missed,
// nothing is a lie; and bounds that are too small are found out.
#include "bench/person/person_trial.h"

#include <string>

#include <gtest/gtest.h>

namespace foretouch::tools {
namespace {

const std::string kExamples = std::string(FORETOUCH_EXAMPLE_FOLDER) + "/";

class DancerHeldBack : public testing::Test {
 protected:
  void SetUp() override {
    auto stage = loadStage("room", kExamples + "room.obj", false);
    ASSERT_TRUE(stage.ok()) << describe(stage.error());
    auto actor = loadActor(kExamples + "dancer.bvh");
    ASSERT_TRUE(actor.ok()) << describe(actor.error());
    stage_.emplace(std::move(stage).value());
    actor_.emplace(std::move(actor).value());
    auto& frames = actor_->clip.frames;
    frames.resize(std::min<std::size_t>(frames.size(), 300));
  }
  PersonTally judge(const PersonTrial& trial) {
    return judgePerson(*stage_, *actor_, Placement{}, trial);
  }
  std::optional<SolidStage> stage_;
  std::optional<SolidActor> actor_;
};

TEST_F(DancerHeldBack, NothingIsMissedAndNothingIsALie) {
  PersonTally all;
  for (const MotionModel model :
       {MotionModel::ConstantRate, MotionModel::Cubic, MotionModel::CubicLate}) {
    for (const double rate : {15.0, 5.0}) {
      for (const bool isFollowed : {false, true}) {
        PersonTrial trial;
        trial.rateHz = rate;
        trial.model = model;
        trial.isFollowed = isFollowed;
        all.add(judge(trial));
      }
    }
  }
  for (const std::string& finding : all.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(all.missed, 0U);
  EXPECT_EQ(all.lied, 0U);
  EXPECT_GT(all.certain, 200U);
  EXPECT_GT(all.excluded, 5000U);
  EXPECT_GT(all.possible, 200U);
  EXPECT_GT(all.freshCertain, 30U);
  EXPECT_EQ(all.unclaimed, 0U);
}

TEST_F(DancerHeldBack, OwnLinksLikewise) {
  PersonTrial trial;
  trial.rateHz = 10.0;
  trial.asksOwnLinks = true;
  const PersonTally tally = judge(trial);
  for (const std::string& finding : tally.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(tally.missed + tally.lied, 0U);
  EXPECT_GT(tally.excluded, 1000U);
}

TEST_F(DancerHeldBack, BoundsThatAreTooSmallAreFoundOut) {
  PersonTrial trial;
  trial.rateHz = 5.0;
  trial.boundShare = 0.1;
  EXPECT_GT(judge(trial).missed, 0U);
}

// Faults as the library could have them, each found out: half a bound, a growth without the error
// of poses at its ends, and slopes of the wrong joint.
TEST_F(DancerHeldBack, HalfABoundIsFoundOut) {
  PersonTally tally;
  for (const double rate : {15.0, 10.0, 5.0}) {
    for (const MotionModel model : {MotionModel::ConstantRate, MotionModel::CubicLate}) {
      PersonTrial trial;
      trial.rateHz = rate;
      trial.model = model;
      trial.boundShare = 0.5;
      tally.add(judge(trial));
    }
  }
  EXPECT_GT(tally.missed + tally.lied, 0U);
}

TEST_F(DancerHeldBack, AnErrorOfPosesBelongsToTheGrowthAtTheEnds) {
  PersonTrial trial;
  trial.rateHz = 5.0;
  trial.model = MotionModel::ConstantRate;  // errors bend a cubic, too
  trial.poseErrorM = 0.02;
  PersonTally tally = judge(trial);
  for (const std::string& finding : tally.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(tally.missed + tally.lied, 0U);
  trial.claimsPoseError = false;
  tally = judge(trial);
  EXPECT_GT(tally.missed + tally.lied, 0U);
}

TEST_F(DancerHeldBack, SlopesOfTheWrongJointAreFoundOut) {
  PersonTrial trial;
  trial.rateHz = 15.0;
  trial.isFollowed = false;
  EXPECT_EQ(judge(trial).missed, 0U);
  trial.hasWrongSlopes = true;
  const PersonTally tally = judge(trial);
  EXPECT_GT(tally.missed + tally.lied, 0U);
}

/// A better model needs smaller bounds, and leaves less open.
TEST_F(DancerHeldBack, ACubicLeavesLessOpen) {
  PersonTrial trial;
  trial.rateHz = 15.0;
  trial.model = MotionModel::ConstantRate;
  const PersonTally constant = judge(trial);
  trial.model = MotionModel::CubicLate;
  EXPECT_LT(judge(trial).possible, constant.possible);
}

}  // namespace
}  // namespace foretouch::tools
