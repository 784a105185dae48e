// What brackets say of a ball whose true touches are known in closed form.
#include <cmath>

#include <gtest/gtest.h>

#include "middleware/bracket/bracket.h"
#include "tests/middleware/balls.h"
#include "tests/middleware/own_body.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.1, kStepS = 0.1;

/// A wide plate at y = 0.
Scene plate() {
  RawScene raw;
  raw.objectNames = {"plate"};
  raw.triangles = {{{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(9, 0, 9)}},
                   {{Vector3d(-9, 0, -9), Vector3d(9, 0, 9), Vector3d(-9, 0, 9)}}};
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

Pose poseAt(double y) {
  Pose pose;
  pose.rotations = {Quaternion::Identity()};
  pose.translations = {Vector3d(0.3, y, 0.2)};
  return pose;
}

/// The least t in [0,1] with f(t) <= 0, of a function that falls.
template <typename Function>
double firstRoot(const Function& f) {
  double low = 0.0, high = 1.0;
  if (f(low) <= 0.0) return 0.0;
  if (f(high) > 0.0) return 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) <= 0.0 ? high : low) = middle;
  }
  return high;
}

class BallOverPlate : public testing::Test {
 protected:
  LinkBracket ask(double y0, double y1, const LinkBound& bound) {
    const Pose from = poseAt(y0), to = poseAt(y1);
    PosedStep step;
    step.from = &from;
    step.to = &to;
    step.seconds = kStepS;
    EXPECT_TRUE(query_.answer(step, MotionModel::ConstantRate, {bound}, scratch_, brackets_).ok());
    return brackets_.links.front();
  }
  BracketQuery query_ = BracketQuery::build(test::ball(kRadius), plate()).value();
  Scratch scratch_;
  StepBrackets brackets_;
};

double rhoAt(double most, double error, double t) {
  return error + 4.0 * most * t * (1.0 - t);
}

TEST_F(BallOverPlate, BracketsTheTouchBetweenTheGrownAndTheShrunkBall) {
  LinkBound bound;
  bound.acceleration = 20.0;
  bound.error = 0.002;
  const double most = 20.0 * kStepS * kStepS / 8.0;
  const double y0 = 0.3, y1 = 0.04;
  const auto height = [&](double t) { return y0 + t * (y1 - y0) - kRadius; };
  const LinkBracket bracket = ask(y0, y1, bound);
  ASSERT_EQ(bracket.verdict, BracketVerdict::Certain);
  const double first = firstRoot([&](double t) { return height(t) - rhoAt(most, 0.002, t); });
  const double surely = firstRoot([&](double t) { return height(t) + rhoAt(most, 0.002, t); });
  // A thousandth of the growth, and half as much again for what the growth changes meanwhile.
  const double slack = 1.5 * (most + 0.002) / 1000.0 / (y0 - y1);
  EXPECT_LE(bracket.possibleFrom, first);
  EXPECT_GE(bracket.possibleFrom, first - slack);
  EXPECT_GE(bracket.certainFrom, surely);
  EXPECT_LE(bracket.certainFrom, surely + slack);
  EXPECT_EQ(bracket.possibleUntil, 1.0);
  EXPECT_GE(bracket.certainUntil, 1.0 - 1e-12);
  EXPECT_NEAR(bracket.growth, most + 0.002, 1e-9);
}

/// The same plate, in so many cells a side: up to thousands of leaves near the ball.
Scene platesOf(int cells) {
  RawScene raw;
  raw.objectNames = {"plate"};
  const auto corner = [&](int x, int z) {
    return Vector3d(-9.0 + 18.0 * x / cells, 0.0, -9.0 + 18.0 * z / cells);
  };
  for (int x = 0; x < cells; ++x) {
    for (int z = 0; z < cells; ++z) {
      raw.triangles.push_back({{corner(x, z), corner(x + 1, z), corner(x + 1, z + 1)}});
      raw.triangles.push_back({{corner(x, z), corner(x + 1, z + 1), corner(x, z + 1)}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

// However many triangles a surface is made of, brackets of it are the same: those of a few are
// listed, those of many are walked, part of the step by part.
TEST_F(BallOverPlate, ASurfaceOfManyTrianglesIsTheSameSurface) {
  constexpr double kSlack = 2e-3;  // of instants: the resolution, by the least speed below
  int certain = 0, possible = 0, excluded = 0;
  for (const int cells : {60, 240}) {
    const auto plates = BracketQuery::build(test::ball(kRadius), platesOf(cells)).value();
    for (int i = 0; i < 50; ++i) {
      test::Random random(static_cast<std::uint64_t>(i));
      LinkBound bound;
      bound.acceleration = std::pow(10.0, random.uniform(0.0, 3.5));  // 1 mm to 4 m
      const double y0 = random.uniform(-0.3, 0.6);
      const double y1 = y0 + (i % 2 == 0 ? 1.0 : -1.0) * random.uniform(0.1, 0.6);
      const LinkBracket one = ask(y0, y1, bound);
      const Pose from = poseAt(y0), to = poseAt(y1);
      PosedStep step;
      step.from = &from;
      step.to = &to;
      step.seconds = kStepS;
      StepBrackets brackets;
      ASSERT_TRUE(plates.answer(step, MotionModel::ConstantRate, {bound}, scratch_, brackets).ok());
      const LinkBracket& many = brackets.links.front();
      SCOPED_TRACE(testing::Message() << cells << " cells, case " << i);
      const bool isPassage =
          one.verdict == BracketVerdict::Certain && one.certainUntil < one.certainFrom;
      if (isPassage) continue;  // not looked for among so many
      ASSERT_EQ(many.verdict, one.verdict);
      EXPECT_NEAR(many.possibleFrom, one.possibleFrom, kSlack);
      EXPECT_NEAR(many.possibleUntil, one.possibleUntil, kSlack);
      certain += one.verdict == BracketVerdict::Certain ? 1 : 0;
      possible += one.verdict == BracketVerdict::Possible ? 1 : 0;
      excluded += one.verdict == BracketVerdict::Excluded ? 1 : 0;
      if (one.verdict != BracketVerdict::Certain) continue;
      EXPECT_NEAR(many.certainFrom, one.certainFrom, kSlack);
      EXPECT_NEAR(many.certainUntil, one.certainUntil, kSlack);
    }
  }
  EXPECT_GT(certain, 20);
  EXPECT_GT(possible, 10);
  EXPECT_GT(excluded, 10);
}

TEST_F(BallOverPlate, LeavingIsEnteringBackwards) {
  LinkBound bound;
  bound.acceleration = 20.0;
  const LinkBracket down = ask(0.3, 0.04, bound), up = ask(0.04, 0.3, bound);
  EXPECT_EQ(up.verdict, BracketVerdict::Certain);
  EXPECT_NEAR(up.possibleUntil, 1.0 - down.possibleFrom, 1e-9);
  EXPECT_NEAR(up.certainUntil, 1.0 - down.certainFrom, 1e-9);
  EXPECT_EQ(up.possibleFrom, 0.0);
}

TEST_F(BallOverPlate, WhatStaysFartherThanTheBoundIsExcluded) {
  LinkBound bound;
  bound.acceleration = 20.0;
  const double most = 20.0 * kStepS * kStepS / 8.0;
  EXPECT_EQ(ask(0.2 + most, 0.2 + most, bound).verdict, BracketVerdict::Excluded);
  EXPECT_EQ(ask(kRadius + most + 1e-4, kRadius + most + 1e-4, bound).verdict,
            BracketVerdict::Excluded);
  EXPECT_EQ(ask(kRadius + most - 1e-4, kRadius + most - 1e-4, bound).verdict,
            BracketVerdict::Possible);
}

TEST_F(BallOverPlate, AShrunkRadiusBelowZeroIsCertainOfAPassageAlone) {
  LinkBound bound;
  bound.error = 1.01 * kRadius;
  bound.acceleration = 0.0;
  EXPECT_EQ(ask(0.0, 0.0, bound).verdict, BracketVerdict::Possible);
  EXPECT_EQ(ask(0.3, -0.1, bound).verdict, BracketVerdict::Possible);
  EXPECT_EQ(ask(0.3, -0.3, bound).verdict, BracketVerdict::Certain);
  bound.error = 0.99 * kRadius;
  EXPECT_EQ(ask(0.0, 0.0, bound).verdict, BracketVerdict::Certain);
}

// The ball dips: y(t) = y0 - 4 dip t (1 - t), which pieces of a constant rate cut across.
TEST_F(BallOverPlate, WhatPiecesCutOffADipIsNotLost) {
  constexpr double kMost = 0.02, kError = 0.002, kNear = 1e-3;
  LinkBound bound;
  bound.acceleration = 8.0 * kMost / (kStepS * kStepS);
  bound.error = kError;
  for (const double dip : {0.001, 0.004, 0.01, 0.03, 0.1}) {
    for (const bool isTouched : {false, true}) {
      SCOPED_TRACE(testing::Message() << dip << ", " << isTouched);
      const double y0 = kRadius + dip + kMost + kError + (isTouched ? -kNear : kNear);
      const Pose around = poseAt(y0 + 8.0 * dip), at = poseAt(y0);
      const PosedStep step{&around, &at, &at, &around, kStepS, kStepS, kStepS};
      ASSERT_TRUE(query_.answer(step, MotionModel::CubicLate, {bound}, scratch_, brackets_).ok());
      const LinkBracket& bracket = brackets_.links.front();
      if (!isTouched) {
        EXPECT_EQ(bracket.verdict, BracketVerdict::Excluded);
        continue;
      }
      ASSERT_EQ(bracket.verdict, BracketVerdict::Possible);
      // gap(t) = y0 - error - radius - 4 (dip + most) t (1 - t) = 0
      const double share = 1.0 - kNear / (dip + kMost);
      const double first = 0.5 - 0.5 * std::sqrt(1.0 - share);
      EXPECT_LE(bracket.possibleFrom, first);
      EXPECT_GE(bracket.possibleUntil, 1.0 - first);
    }
  }
}

// The ball goes y(t) = 0.3 - t/2 - 0.3 t^2 + t^3/5, which bends: a few pieces stand for it.
TEST_F(BallOverPlate, APassageIsToldByInstantsThatItSurelyLiesBetween) {
  const Pose before = poseAt(0.7), from = poseAt(0.3), to = poseAt(-0.3), after = poseAt(-0.7);
  const PosedStep step{&before, &from, &to, &after, kStepS, kStepS, kStepS};
  const auto height = [](double t) { return 0.3 - t * (0.5 + t * (0.3 - 0.2 * t)); };
  constexpr double kParts = 2.0 / 16.0;  // one, and what pieces stray meanwhile
  for (const double most : {0.02, 0.05, 0.1}) {
    for (const double error : {1.01 * kRadius, 0.15, 0.2}) {
      SCOPED_TRACE(testing::Message() << most << ", " << error);
      LinkBound bound;
      bound.acceleration = 8.0 * most / (kStepS * kStepS);
      bound.error = error;
      ASSERT_TRUE(query_.answer(step, MotionModel::CubicLate, {bound}, scratch_, brackets_).ok());
      const LinkBracket& bracket = brackets_.links.front();
      ASSERT_EQ(bracket.verdict, BracketVerdict::Certain);
      const auto rho = [&](double t) { return rhoAt(most, error, t); };
      const double front = firstRoot([&](double t) { return height(t) - rho(t); });
      const double behind = firstRoot([&](double t) { return height(t) + rho(t); });
      EXPECT_LE(bracket.certainUntil, front) << "it may touch sooner";
      EXPECT_GE(bracket.certainUntil, front - kParts);
      EXPECT_GE(bracket.certainFrom, behind) << "it may touch later";
      EXPECT_LE(bracket.certainFrom, behind + kParts);
    }
  }
}

TEST_F(BallOverPlate, WithoutABoundNothingIsClaimed) {
  EXPECT_EQ(ask(5.0, 5.0, {}).verdict, BracketVerdict::Unclaimed);
  LinkBound bound;
  bound.followFloor = 0.001;  // of poses around the step, and there are none
  EXPECT_EQ(ask(5.0, 5.0, bound).verdict, BracketVerdict::Unclaimed);
}

TEST_F(BallOverPlate, OfWhoMayBeAnywhereNothingIsClaimed) {
  LinkBound bound;
  bound.acceleration = 9.99 * 8.0 / (kStepS * kStepS);
  EXPECT_EQ(ask(0.3, 0.2, bound).verdict, BracketVerdict::Possible);
  bound.acceleration = 10.01 * 8.0 / (kStepS * kStepS);
  EXPECT_EQ(ask(0.3, 0.2, bound).verdict, BracketVerdict::Unclaimed);
}

TEST_F(BallOverPlate, TheLesserBoundCountsWhereThePosesDoNotBend) {
  const Pose before = poseAt(0.3), from = poseAt(0.2), to = poseAt(0.15), after = poseAt(0.15);
  PosedStep step{&before, &from, &to, &after, kStepS, kStepS, kStepS};
  LinkBound bound;
  bound.acceleration = 1e4;
  bound.followFloor = 0.001;
  bound.followShare = 0.5;
  ASSERT_TRUE(query_.answer(step, MotionModel::ConstantRate, {bound}, scratch_, brackets_).ok());
  // The poses bend by 0.05 m at both ends.
  EXPECT_NEAR(brackets_.links.front().growth, 0.001 + 0.5 * 0.05, 1e-9);
}

TEST_F(BallOverPlate, AcrossAGapASpeedExcludesWhatNobodySaw) {
  const Pose from = poseAt(0.5), to = poseAt(0.5);
  PosedStep step{nullptr, &from, &to, nullptr, 0.0, 1.0, 0.0};
  LinkBound bound;
  bound.speed = 0.79;  // half a second there: 0.395 m of 0.4
  ASSERT_TRUE(query_.answerGap(step, {bound}, scratch_, brackets_).ok());
  EXPECT_EQ(brackets_.links.front().verdict, BracketVerdict::Excluded);
  bound.speed = 0.81;
  ASSERT_TRUE(query_.answerGap(step, {bound}, scratch_, brackets_).ok());
  EXPECT_EQ(brackets_.links.front().verdict, BracketVerdict::Possible);
  EXPECT_NEAR(brackets_.links.front().possibleFrom, 0.4 / 0.81, 1e-3);
  EXPECT_NEAR(brackets_.links.front().possibleUntil, 1.0 - 0.4 / 0.81, 1e-3);
  ASSERT_TRUE(query_.answerGap(step, {LinkBound{}}, scratch_, brackets_).ok());
  EXPECT_EQ(brackets_.links.front().verdict, BracketVerdict::Unclaimed);
}

TEST_F(BallOverPlate, LookingAheadSaysNotBeforeWhen) {
  const Pose from = poseAt(0.6), to = poseAt(0.5);  // 1 m/s down
  PosedStep step{nullptr, &from, &to, nullptr, 0.0, kStepS, 0.0};
  LinkBound bound;
  bound.aheadSpeed = 0.2;
  bound.aheadAcceleration = 4.0;
  bound.error = 0.01;
  ASSERT_TRUE(query_.lookAhead(step, 1.0, {bound}, scratch_, brackets_).ok());
  const LinkBracket& bracket = brackets_.links.front();
  ASSERT_EQ(bracket.verdict, BracketVerdict::Possible);
  const double first = firstRoot([](double s) { return 0.4 - s - 0.01 - 0.2 * s - 2.0 * s * s; });
  EXPECT_LE(bracket.possibleFrom, first);
  EXPECT_NEAR(bracket.possibleFrom, first, 2e-3);
  bound.aheadAcceleration = LinkBound::kNone;
  ASSERT_TRUE(query_.lookAhead(step, 1.0, {bound}, scratch_, brackets_).ok());
  EXPECT_EQ(brackets_.links.front().verdict, BracketVerdict::Unclaimed);
}

TEST(LookAhead, ALinkThatNothingBoundsTakesNothingFromTheOthers) {
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"b", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), kRadius};
  const Avatar two = Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}}).value();
  const BracketQuery query = BracketQuery::build(two, plate()).value();
  LinkBound known, wild;
  known.aheadAcceleration = 0.0;
  wild.aheadAcceleration = 1e9;  // finite: 5e8 m in a second
  Scratch scratch;
  StepBrackets brackets;
  const auto lookFrom = [&](double y, const LinkBound& boundOfOne) {
    Pose pose;
    pose.rotations = {Quaternion::Identity(), Quaternion::Identity()};
    pose.translations = {Vector3d(0.3, 5.0, 0.2), Vector3d(0.3, y, 0.2)};
    const PosedStep step{nullptr, &pose, &pose, nullptr, 0.0, kStepS, 0.0};
    EXPECT_TRUE(query.lookAhead(step, 1.0, {boundOfOne, known}, scratch, brackets).ok());
  };
  lookFrom(5.0, known);
  EXPECT_EQ(brackets.links[1].verdict, BracketVerdict::Excluded);
  lookFrom(0.05, wild);
  EXPECT_EQ(brackets.links[0].verdict, BracketVerdict::Unclaimed);
  EXPECT_EQ(brackets.links[1].verdict, BracketVerdict::Possible);
  EXPECT_EQ(brackets.links[1].possibleFrom, 0.0);
}

TEST_F(BallOverPlate, RefusesBoundsThatAreNone) {
  const Pose pose = poseAt(1.0);
  PosedStep step{nullptr, &pose, &pose, nullptr, 0.0, kStepS, 0.0};
  EXPECT_FALSE(query_.answer(step, MotionModel::Cubic, {}, scratch_, brackets_).ok());
  LinkBound bound;
  bound.error = -1e-9;
  const auto negative = query_.answer(step, MotionModel::Cubic, {bound}, scratch_, brackets_);
  ASSERT_FALSE(negative.ok());
  EXPECT_EQ(negative.error().index, 0);
  bound.error = std::nan("");
  EXPECT_FALSE(query_.answerGap(step, {bound}, scratch_, brackets_).ok());
  EXPECT_FALSE(query_.lookAhead(step, -1.0, {LinkBound{}}, scratch_, brackets_).ok());
}

TEST(BracketQuery, RefusesWhatIsNotOfItsAvatar) {
  const auto ballsOf = [](int count) {
    RawSkeleton raw;
    std::vector<std::vector<Lss>> lss;
    for (int i = 0; i < count; ++i) {
      raw.joints.push_back(
          {"b" + std::to_string(i), kNoParent, Vector3d(i, 0, 0), Quaternion::Identity()});
      lss.push_back({{Vector3d::Zero(), Vector3d::Zero(), kRadius}});
    }
    return Avatar::build(Skeleton::build(raw).value(), lss).value();
  };
  const Avatar one = ballsOf(2), other = ballsOf(3);
  BracketOptions options;
  options.self = PairRules::derive(other).value();
  EXPECT_EQ(BracketQuery::build(one, plate(), options).error().file, "self");
  options = {};
  options.surface = AvatarSurface::build(other, {{}, {}, {}}).value();
  EXPECT_EQ(BracketQuery::build(one, plate(), options).error().file, "surface");
}

TEST(OwnLinks, BothGrowthsAdd) {
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"b", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), kRadius};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}}).value();
  BracketOptions options;
  options.self = PairRules::asking(avatar, {{0, 1}}).value();
  const BracketQuery query = BracketQuery::build(avatar, test::farScene(), options).value();
  Pose pose = restPose(avatar.skeleton());
  pose.translations[1].x() = 2.0 * kRadius + 0.03;
  PosedStep step{nullptr, &pose, &pose, nullptr, 0.0, kStepS, 0.0};
  LinkBound bound;
  bound.acceleration = 0.0;
  Scratch scratch;
  StepBrackets brackets;
  for (const auto& [error, isFar] : {std::pair{0.0149, true}, std::pair{0.0151, false}}) {
    bound.error = error;
    ASSERT_TRUE(
        query.answer(step, MotionModel::ConstantRate, {bound, bound}, scratch, brackets).ok());
    EXPECT_EQ(brackets.pairs.empty(), isFar) << error;
  }
  pose.translations[1].x() = 2.0 * kRadius - 0.04;
  ASSERT_TRUE(
      query.answer(step, MotionModel::ConstantRate, {bound, bound}, scratch, brackets).ok());
  ASSERT_EQ(brackets.pairs.size(), 1U);
  EXPECT_EQ(brackets.pairs.front().verdict, BracketVerdict::Certain);
  EXPECT_EQ(brackets.pairs.front().other, 1);
}

}  // namespace
}  // namespace foretouch
