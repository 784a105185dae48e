// How near motions come, held against the judge at many instants.
#include "middleware/near/clearance.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/middleware/near/clearance_campaign.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using test::ClearanceTally;
using test::judgeClearances;
using test::Random;

TEST(ClearanceQuery, HoldsBetweenBothBounds) {
  ClearanceTally all;
  for (std::uint64_t seed = 0; seed < 150; ++seed) all.add(judgeClearances(seed, 4));
  for (const std::string& problem : all.problems) ADD_FAILURE() << problem;
  EXPECT_GT(all.asked, 500);
  EXPECT_GT(all.touching, 8);
  EXPECT_LT(all.touching, 300);
  EXPECT_GT(all.farther, 5);
  EXPECT_GT(all.alone, 50);
}

TEST(ClearanceQuery, TheJudgeSeesWrongBounds) {
  const auto problemsOf = [](const auto& tamper) {
    ClearanceTally all;
    for (std::uint64_t seed = 0; seed < 40; ++seed) all.add(judgeClearances(seed, 2, tamper));
    return all.problems.size();
  };
  EXPECT_GT(problemsOf([](Clearance& answer) { answer.lower = answer.upper + 0.1; }), 10u);
  EXPECT_GT(problemsOf([](Clearance& answer) { answer.t = 1.0 - answer.t; }), 3u);
  EXPECT_GT(problemsOf([](Clearance& answer) { answer.lower = 0.0; }), 10u);
}

TEST(ClearanceQuery, RefusesWhatItCannotHonour) {
  Random random(1);
  const auto body = test::bodyInClutter(random, 2, Eigen::Vector3d::Zero());
  const auto scene = Scene::build(test::clutter(random, 5, 1, Eigen::Vector3d::Zero())).value();
  ClearanceOptions options;
  options.tolerance = 0.0;
  EXPECT_FALSE(ClearanceQuery::build(body.avatar, scene, options).ok());
  options = {};
  options.within = 0.0;
  EXPECT_FALSE(ClearanceQuery::build(body.avatar, scene, options).ok());
  options = {};
  options.ignored = {{7}};
  EXPECT_FALSE(ClearanceQuery::build(body.avatar, scene, options).ok());
}

TEST(ClearanceQuery, NobodyAskedComesNoNearerThanItLooks) {
  Random random(1);
  const auto body = test::bodyInClutter(random, 1, Eigen::Vector3d::Zero());
  const auto scene = Scene::build(test::clutter(random, 5, 1, Eigen::Vector3d::Zero())).value();
  ClearanceOptions options;
  options.within = 2.0;
  options.ignored = {{0}};
  Scratch scratch;
  const Clearance none =
      ClearanceQuery::build(body.avatar, scene, options).value().answer(body.motion(), scratch);
  EXPECT_EQ(none.lower, 2.0);
  EXPECT_EQ(none.triangle, -1);
}

}  // namespace
}  // namespace foretouch
