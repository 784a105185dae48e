// tests/oracle/obstacles_test.cpp: what stands beside is where the body goes, and a sample of the
// campaign among it: the bundled dancer on a floor.
#include "tests/oracle/obstacles.h"

#include <gtest/gtest.h>

#include "bench/solid/figure.h"
#include "tests/oracle/solid_campaign.h"

namespace foretouch::test {
namespace {

constexpr Obstacles kAll[] = {Obstacles::Plates, Obstacles::Cage, Obstacles::Spikes};

tools::SolidStage floorAlone() {
  RawScene raw;
  tools::addSheet(raw, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  return tools::stageOf("a floor", std::move(raw));
}

tools::SolidActor dancer() {
  return tools::loadActor(FORETOUCH_EXAMPLE_FOLDER "/dancer.bvh").value();
}

TEST(Obstacles, AreApartFromTheFirstPoseAndWhereTheBodyGoes) {
  const tools::SolidActor actor = dancer();
  foretouch::Placement place;
  place.origin.y() = 0.05 - actor.lowestM;
  const auto poses = tools::trackedPoses(actor, place, 30.0, 0.0, 8.0);
  for (const Obstacles kind : kAll) {
    for (std::uint64_t seed = 1; seed < 6; ++seed) {
      const auto stage = withObstacles(floorAlone(), kind, actor.avatar, poses, seed);
      oracle::WayJudge judge(stage.judged, tools::plainBody(actor.avatar));
      int met = 0;
      for (const Pose& pose : poses) met += judge.at(tools::plainPose(pose), 0.0).link >= 0 ? 1 : 0;
      EXPECT_LT(judge.at(tools::plainPose(poses.front()), 0.009).link, 0) << toString(kind);
      EXPECT_GT(met, 5) << toString(kind) << ", seed " << seed;
      // The same again, and others for another seed.
      const auto again = withObstacles(floorAlone(), kind, actor.avatar, poses, seed),
                 other = withObstacles(floorAlone(), kind, actor.avatar, poses, seed + 100);
      EXPECT_EQ(stage.judged.triangle(0), again.judged.triangle(0));
      EXPECT_NE(stage.judged.triangle(0), other.judged.triangle(0));
    }
  }
}

TEST(Obstacles, ASolidAvatarAmongThemKeepsItsPromises) {
  const tools::SolidActor actor = dancer();
  const tools::SolidStage stage = floorAlone();
  for (const Obstacles kind : kAll) {
    SolidCampaignTally total;
    std::uint64_t seed = 0;
    for (const double rateHz : {90.0, 60.0, 30.0}) {
      for (const double sunk : {0.0, 0.08}) {
        SolidCampaign campaign;
        campaign.rateHz = rateHz;
        campaign.sunk = sunk;
        campaign.beside = kind;
        campaign.seconds = 2.0;
        campaign.seed = ++seed;
        total.add(judgeSolid(stage, actor, campaign));
      }
    }
    for (const std::string& finding : total.way.findings) ADD_FAILURE() << finding;
    for (const std::string& finding : total.motion.findings) ADD_FAILURE() << finding;
    EXPECT_EQ(total.way.violations() + total.motion.violations(), 0u) << toString(kind);
    EXPECT_EQ(total.places, 6u) << toString(kind);
    // It was kept from the tracked pose, and lifted.
    EXPECT_GT(total.way.states[static_cast<std::size_t>(SolidState::Sliding)], 20u);
    EXPECT_GT(total.motion.lifted, 0.04);
  }
}

}  // namespace
}  // namespace foretouch::test
