// The truth that `bench peers` judges by: closed forms, fifty digits, and dense samples.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/peers/motion_sets.h"
#include "judge/distance.h"
#include "judge/plain_motion.h"
#include "tests/support/judged.h"
#include "tests/tools/random_clutter.h"
#include "tools/portable_random.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using oracle::FirstTouch;
using oracle::TouchOutcome;
using tools::PortableRandom;
using tools::RigidSweep;

const std::vector<Triangle> kFloor = {
    {{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 18)}}};

/// Of all triangles, in long double.
oracle::Real leastDistance(const std::vector<Triangle>& scene, const Vector3d& a,
                           const Vector3d& b) {
  oracle::Real least = std::numeric_limits<oracle::Real>::infinity();
  const auto first = plain(a).as<oracle::Real>(), last = plain(b).as<oracle::Real>();
  for (const Triangle& t : scene) {
    const auto corners = oracle::cornersOf<oracle::Real>(plain(t));
    least = std::min(least, oracle::closestPoints(first, last, corners).distance);
  }
  return least;
}

/// The same, by other formulas in fifty digits of those triangles that may be the nearest.
double preciseLeast(const std::vector<Triangle>& scene, const Vector3d& a, const Vector3d& b) {
  const oracle::Real enough = leastDistance(scene, a, b) + 1e-9L;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : scene) {
    if (leastDistance({t}, a, b) > enough) continue;
    const auto distance = oracle::preciseDistance(oracle::Precise3(a), oracle::Precise3(b),
                                                  oracle::cornersOf<oracle::Precise>(plain(t)));
    least = std::min(least, static_cast<double>(distance));
  }
  return least;
}

TEST(DistanceTo, IsTheLeastOfAllTrianglesInFiftyDigits) {
  std::vector<Triangle> clutter = randomClutter(600, 1);
  clutter.push_back({{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1)}});  // a point
  clutter.push_back({{Vector3d(0, 1, 0), Vector3d(1, 1, 0), Vector3d(3, 1, 0)}});  // a segment
  const oracle::Scene scene(plain(clutter));
  PortableRandom random(7);
  int meeting = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d a = random.inBox(1.5);
    const Vector3d b = i % 10 == 0 ? a : Vector3d(a + random.inBox(0.5));
    const double expected = preciseLeast(clutter, a, b);
    meeting += expected == 0.0 ? 1 : 0;
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(distanceTo(scene, plain(a), plain(b), infinity), expected, 1e-13) << i;
    EXPECT_EQ(distanceTo(scene, plain(a), plain(b), 0.5 * expected), 0.5 * expected) << i;
    EXPECT_NEAR(distanceTo(scene, plain(a), plain(b), 2.0 * expected), expected, 1e-13) << i;
  }
  EXPECT_GT(meeting, 20);
  EXPECT_LT(meeting, 400);
}

TEST(FirstTouch, OfAFallIsTheHeightOverTheSpeed) {
  const oracle::Scene scene(plain(kFloor));
  RigidSweep sweep;
  sweep.lss_L = {Vector3d(0, 0, 0.1), Vector3d(0, 0.2, 0.4), 0.06};
  sweep.from = Vector3d(0, 0.36, 0);
  sweep.to = Vector3d(0.1, -0.04, 0.2);
  const FirstTouch touch = firstTouch(scene, sweep, 0.06);
  EXPECT_EQ(touch.outcome, TouchOutcome::Touch);
  EXPECT_NEAR(touch.t, 0.75, 1e-8);
  EXPECT_LE(touch.t, 0.75);
  EXPECT_NEAR(firstTouch(scene, sweep, 0.02).t, 0.85, 1e-8);
  sweep.to = sweep.from - Vector3d(0, 0.299, 0);
  EXPECT_EQ(firstTouch(scene, sweep, 0.06).outcome, TouchOutcome::Free);
}

TEST(FirstTouch, OfASwungRodIsTheArcSine) {
  const oracle::Scene scene(plain(kFloor));
  RigidSweep sweep;
  sweep.lss_L = {Vector3d(0.1, 0, 0), Vector3d(0.4, 0, 0), 0.01};
  sweep.from = sweep.to = Vector3d(0, 0.21, 0);
  sweep.turn = Vector3d(0, 0, -1.2);  // down about z: the tip is at 0.21 - 0.4 sin(1.2 t)
  const double expected = std::asin((0.21 - 0.01) / 0.4) / 1.2;
  const FirstTouch touch = firstTouch(scene, sweep, 0.01);
  EXPECT_EQ(touch.outcome, TouchOutcome::Touch);
  EXPECT_LE(touch.t, expected);
  EXPECT_NEAR(touch.t, expected, 1e-8);
}

TEST(FirstTouch, SaysSoWhereItCannotTell) {
  const oracle::Scene scene(plain(kFloor));
  RigidSweep sweep;
  sweep.lss_L = {Vector3d::Zero(), Vector3d(0.3, 0, 0), 0.06};
  sweep.from = Vector3d(0, 0.06 + 5e-9, 0);
  sweep.to = sweep.from + Vector3d(0.5, 0, 0);
  EXPECT_EQ(firstTouch(scene, sweep, 0.06).outcome, TouchOutcome::Uncertain);
}

TEST(FirstTouch, AgreesWithDenseSampling) {
  const std::vector<Triangle> clutter = randomClutter(200, 3);
  const oracle::Scene scene(plain(clutter));
  constexpr int kCases = 80, kSamples = 300;
  PortableRandom random(11);
  int touching = 0, judged = 0;
  for (int i = 0; i < kCases; ++i) {
    RigidSweep sweep;
    sweep.lss_L = {random.inBox(0.3), random.inBox(0.3), 0.03};
    sweep.from = random.inBox(1.0);
    sweep.to = sweep.from + random.inBox(0.5);
    sweep.turn = random.inBox(1.0);
    const auto separation = [&](double t) {
      const auto axis = axisAt(sweep, t);
      return static_cast<double>(leastDistance(clutter, axis.a, axis.b)) - 0.03;
    };
    if (separation(0.0) <= 0.0) continue;
    const FirstTouch touch = firstTouch(scene, sweep, 0.03);
    ASSERT_NE(touch.outcome, TouchOutcome::Uncertain);
    ++judged;
    for (int k = 0; k <= kSamples; ++k) {
      ASSERT_GT(separation(touch.t * k / kSamples), 0.0) << i << ' ' << k;
    }
    if (touch.outcome == TouchOutcome::Free) continue;
    ++touching;
    EXPECT_LE(separation(touch.t), 2.0 * oracle::kTouchSeparation) << i;
  }
  EXPECT_GT(touching, judged * 2 / 10);
  EXPECT_LT(touching, judged * 9 / 10);
  EXPECT_GT(judged, kCases / 2);
}

}  // namespace
}  // namespace foretouch::test
