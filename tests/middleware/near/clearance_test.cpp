// How near motions come, held against the judge at many instants.
#include "middleware/near/clearance.h"

#include <string>

#include <gtest/gtest.h>

#include "middleware/near/clearance_search.h"
#include "tests/middleware/near/clearance_campaign.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/solid/ball_alone.h"

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

/// Places that are known to a centimetre alone are a centimetre wide.
TEST(ClearanceSearch, HoldsAllPlacesThatTheMotionMayStandFor) {
  const Avatar avatar = test::ballAlone(0.1);
  const Pose from = test::ballAt({0.0, 0.0, 1.0}), to = test::ballAt({0.1, 0.0, 0.5});
  const ChainMotion motion(avatar.skeleton(), from, to);
  ClearanceOptions options;
  options.tolerance = 0.25;  // more than twice what is not known
  const internal::ClearancePlan plan(avatar, test::boardAt(Eigen::Vector3d::Zero(), 1.0), options);
  for (const double rounding : {0.0, 0.01, 0.1}) {
    internal::ClearanceMemory memory;
    internal::ClearanceSearch search(options, memory);
    search.look({&plan, &motion, rounding});
    const Clearance found = search.finish();
    EXPECT_LE(found.lower, 0.4 - rounding);
    EXPECT_GE(found.lower, 0.4 - rounding - options.tolerance);
    EXPECT_GE(found.upper, 0.4 + rounding);
  }
}

}  // namespace
}  // namespace foretouch
