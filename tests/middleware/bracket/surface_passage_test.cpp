// Who is on the other side of a wall has passed it, if there was no way around: claimed where that
// is so, and never where there is one.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/bracket/bracket.h"
#include "tests/middleware/balls.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

/// Thinner than any growth below.
constexpr double kThin = 0.005, kSpanS = 0.1;

void addRectangle(RawScene& raw, const std::array<Vector3d, 4>& corners) {
  raw.triangles.push_back({{corners[0], corners[1], corners[2]}});
  raw.triangles.push_back({{corners[0], corners[2], corners[3]}});
}

/// The rectangles between the lines of a grid in the plane y; `holes`: left out.
void addGrid(RawScene& raw, const std::vector<double>& x, const std::vector<double>& z, double y,
             const std::vector<std::pair<std::size_t, std::size_t>>& holes = {}) {
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      if (std::find(holes.begin(), holes.end(), std::pair{i, k}) != holes.end()) continue;
      addRectangle(raw, {Vector3d(x[i], y, z[k]), Vector3d(x[i + 1], y, z[k]),
                         Vector3d(x[i + 1], y, z[k + 1]), Vector3d(x[i], y, z[k + 1])});
    }
  }
}

Scene sceneOf(RawScene raw) {
  raw.objectNames = {"wall"};
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

/// Of a ball that the model moves down the line x = z = 0, from y0 to y1.
LinkBracket askThrough(const Scene& scene, double y0, double y1, double most, double error = 0.0) {
  const BracketQuery query = BracketQuery::build(test::ball(kThin), scene).value();
  Pose from;
  from.rotations = {Quaternion::Identity()};
  from.translations = {Vector3d(0.0, y0, 0.0)};
  Pose to = from;
  to.translations[0].y() = y1;
  const PosedStep step{nullptr, &from, &to, nullptr, 0.0, kSpanS, 0.0};
  LinkBound bound;
  bound.acceleration = 8.0 * most / (kSpanS * kSpanS);
  bound.error = error;
  Scratch scratch;
  StepBrackets brackets;
  EXPECT_TRUE(query.answer(step, MotionModel::ConstantRate, {bound}, scratch, brackets).ok());
  return brackets.links.front();
}

/// When the bound lets the ball's centre be in the plane y = 0: from the first instant to the last.
std::pair<double, double> mayBeInPlane(double y0, double y1, double most) {
  double first = 2.0, last = -1.0;
  for (int i = 0; i <= 100'000; ++i) {
    const double t = 1e-5 * i;
    if (std::abs(y0 + t * (y1 - y0)) > 4.0 * most * t * (1.0 - t)) continue;
    first = std::min(first, t);
    last = std::max(last, t);
  }
  return {first, last};
}

Scene wall() {
  RawScene raw;
  addGrid(raw, {-3.0, -1.0, 0.25, 3.0}, {-3.0, 0.5, 3.0}, 0.0);
  return sceneOf(std::move(raw));
}

TEST(SurfacePassage, ThroughALargeWallIsCertain) {
  const double most = 0.1;
  const LinkBracket bracket = askThrough(wall(), 0.2, -0.3, most);
  ASSERT_EQ(bracket.verdict, BracketVerdict::Certain);
  const auto [first, last] = mayBeInPlane(0.2, -0.3, most);
  EXPECT_LE(bracket.certainUntil, first);
  EXPECT_GE(bracket.certainFrom, last);
  EXPECT_GE(bracket.certainUntil, first - 0.1);
  EXPECT_LE(bracket.certainFrom, last + 0.1);
  EXPECT_LE(bracket.possibleFrom, bracket.certainUntil);
  EXPECT_GE(bracket.possibleUntil, bracket.certainFrom);
}

TEST(SurfacePassage, WhoMayBeOnEitherSideAtAPoseHasNotSurelyPassed) {
  EXPECT_EQ(askThrough(wall(), 0.2, -0.3, 0.1, 0.19).verdict, BracketVerdict::Certain);
  EXPECT_EQ(askThrough(wall(), 0.2, -0.3, 0.1, 0.21).verdict, BracketVerdict::Possible);
  EXPECT_EQ(askThrough(wall(), 0.3, -0.2, 0.1, 0.21).verdict, BracketVerdict::Possible);
}

TEST(SurfacePassage, WhoStaysOnOneSideHasNotSurelyPassed) {
  EXPECT_EQ(askThrough(wall(), 0.02, 0.02, 0.1).verdict, BracketVerdict::Possible);
  EXPECT_EQ(askThrough(wall(), 0.2, 0.02, 0.1).verdict, BracketVerdict::Possible);
}

/// Either face is passed, and the way from one to the other leads around the rim, far away.
TEST(SurfacePassage, ThroughBothFacesOfASlabIsCertain) {
  RawScene raw;
  addGrid(raw, {-3.0, -1.0, 3.0}, {-3.0, 0.5, 3.0}, 0.0);
  addGrid(raw, {-3.0, -1.0, 3.0}, {-3.0, 0.5, 3.0}, -0.02);
  for (const double x : {-3.0, 3.0}) {
    addRectangle(raw, {Vector3d(x, 0, -3), Vector3d(x, 0, 0.5), Vector3d(x, -0.02, 0.5),
                       Vector3d(x, -0.02, -3)});
    addRectangle(raw, {Vector3d(x, 0, 0.5), Vector3d(x, 0, 3), Vector3d(x, -0.02, 3),
                       Vector3d(x, -0.02, 0.5)});
  }
  EXPECT_EQ(askThrough(sceneOf(std::move(raw)), 0.2, -0.3, 0.1).verdict, BracketVerdict::Certain);
}

TEST(SurfacePassage, AFaceThatStandsTwiceIsOne) {
  RawScene raw;
  addGrid(raw, {-3.0, -1.0, 3.0}, {-3.0, 0.5, 3.0}, 0.0);
  addGrid(raw, {-3.0, -1.0, 3.0}, {-3.0, 0.5, 3.0}, 0.0);
  EXPECT_EQ(askThrough(sceneOf(std::move(raw)), 0.2, -0.3, 0.1).verdict, BracketVerdict::Certain);
}

/// A box that the ball is in at the later pose; and one that fits into the region, through which
/// nobody need have gone.
TEST(SurfacePassage, IntoABoxIsCertainAndPastASmallOneIsNot) {
  for (const auto& [half, isCertain] : {std::pair{0.1, true}, std::pair{0.02, false}}) {
    RawScene raw;
    const double y1 = isCertain ? 0.0 : -0.3;
    const auto corner = [&, h = half](int i) {
      return Vector3d((i & 1) != 0 ? h : -1.1 * h, (i & 2) != 0 ? h : -h, (i & 4) != 0 ? h : -h);
    };
    for (const auto& face :
         {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
          std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
      addRectangle(raw, {corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])});
    }
    EXPECT_EQ(askThrough(sceneOf(std::move(raw)), 0.3, y1, 0.1).verdict,
              isCertain ? BracketVerdict::Certain : BracketVerdict::Possible);
  }
}

/// Two sheets whose corners do not meet: a border, however narrow the crack is.
TEST(SurfacePassage, ThroughACrackThereIsAWay) {
  RawScene raw;
  addGrid(raw, {-3.0, 0.03}, {-3.0, 3.0}, 0.0);
  addGrid(raw, {0.03 + 1e-9, 3.0}, {-3.0, 3.0}, 0.0);
  EXPECT_EQ(askThrough(sceneOf(std::move(raw)), 0.2, -0.3, 0.1).verdict, BracketVerdict::Possible);
}

TEST(SurfacePassage, AcrossAGapTheSpeedDecides) {
  const Pose from{{Quaternion::Identity()}, {Vector3d(0.0, 0.3, 0.0)}};
  const Pose to{{Quaternion::Identity()}, {Vector3d(0.0, -0.3, 0.0)}};
  const PosedStep step{nullptr, &from, &to, nullptr, 0.0, 1.0, 0.0};
  RawScene raw;
  addGrid(raw, {-1.0, 1.0}, {-1.0, 0.9, 1.2}, 0.0);
  const BracketQuery query = BracketQuery::build(test::ball(kThin), sceneOf(raw)).value();
  Scratch scratch;
  StepBrackets brackets;
  for (const auto& [speed, isCertain] : {std::pair{1.0, true}, std::pair{2.1, false}}) {
    LinkBound bound;
    bound.speed = speed;
    ASSERT_TRUE(query.answerGap(step, {bound}, scratch, brackets).ok());
    EXPECT_EQ(brackets.links.front().verdict,
              isCertain ? BracketVerdict::Certain : BracketVerdict::Possible);
  }
}

/// A square hole somewhere. How far from the line the bound lets the ball be as it passes the plane
/// is known: where that reaches the hole, there is a way.
TEST(SurfacePassage, NeverWhereTheBoundReachesAHole) {
  int numCertain = 0, numReached = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    const double half = random.uniform(1e-4, 0.1), most = random.uniform(0.02, 0.2);
    const double x = random.uniform(-0.4, 0.4), z = random.uniform(-0.4, 0.4);
    const double y0 = random.uniform(0.01, 0.3), y1 = -random.uniform(0.01, 0.3);
    RawScene raw;
    addGrid(raw, {-5.0, x - half, x + half, 5.0}, {-5.0, z - half, z + half, 5.0}, 0.0, {{1, 1}});
    double reach = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = 1e-3 * i, rho = 4.0 * most * t * (1.0 - t), y = y0 + t * (y1 - y0);
      reach = std::max(reach, std::sqrt(std::max(0.0, rho * rho - y * y)));
    }
    const double far =
        std::hypot(std::max(0.0, std::abs(x) - half), std::max(0.0, std::abs(z) - half));
    const LinkBracket bracket = askThrough(sceneOf(std::move(raw)), y0, y1, most);
    if (far < reach) {
      ++numReached;
      EXPECT_NE(bracket.verdict, BracketVerdict::Certain);
    } else if (far > 1.2 * most && bracket.growth > kThin) {
      ++numCertain;
      EXPECT_EQ(bracket.verdict, BracketVerdict::Certain);
      const auto [first, last] = mayBeInPlane(y0, y1, most);
      EXPECT_LE(bracket.certainUntil, first);
      EXPECT_GE(bracket.certainFrom, last);
    }
  }
  EXPECT_GT(numReached, 50);
  EXPECT_GT(numCertain, 100);
}

}  // namespace
}  // namespace foretouch
