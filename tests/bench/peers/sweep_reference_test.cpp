// The truth that `bench peers` judges by: closed forms, and the oracle's distance at dense samples.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/peers/reference.h"
#include "tests/support/oracle_distance.h"
#include "tests/tools/random_clutter.h"
#include "tools/portable_random.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using tools::FirstTouch;
using tools::PortableRandom;
using tools::ReferenceScene;
using tools::RigidSweep;
using tools::TouchOutcome;

const std::vector<Triangle> kFloor = {
    {{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 18)}}};

oracle::Vec3<double> wide(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

double oracleDistance(const std::vector<Triangle>& scene, const Vector3d& a, const Vector3d& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : scene) {
    const auto closest = oracle::closestPoints<double>(
        wide(a), wide(b), {wide(t.vertices[0]), wide(t.vertices[1]), wide(t.vertices[2])});
    least = std::min(least, closest.distance);
  }
  return least;
}

TEST(ReferenceScene, MeasuresAsTheOracleDoes) {
  std::vector<Triangle> clutter = randomClutter(600, 1);
  clutter.push_back({{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1)}});  // a point
  clutter.push_back({{Vector3d(0, 1, 0), Vector3d(1, 1, 0), Vector3d(3, 1, 0)}});  // a segment
  const ReferenceScene scene(clutter);
  PortableRandom random(7);
  int meeting = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d a = random.inBox(1.5);
    const Vector3d b = i % 10 == 0 ? a : Vector3d(a + random.inBox(0.5));
    const double expected = oracleDistance(clutter, a, b);
    meeting += expected == 0.0 ? 1 : 0;
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(scene.distance(a, b, infinity), expected, 1e-13) << i;
    EXPECT_EQ(scene.distance(a, b, 0.5 * expected), 0.5 * expected) << i;
    EXPECT_NEAR(scene.distance(a, b, 2.0 * expected), expected, 1e-13) << i;
  }
  EXPECT_GT(meeting, 20);
  EXPECT_LT(meeting, 400);
}

TEST(FirstTouch, OfAFallIsTheHeightOverTheSpeed) {
  const ReferenceScene scene(kFloor);
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
  const ReferenceScene scene(kFloor);
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
  const ReferenceScene scene(kFloor);
  RigidSweep sweep;
  sweep.lss_L = {Vector3d::Zero(), Vector3d(0.3, 0, 0), 0.06};
  sweep.from = Vector3d(0, 0.06 + 5e-9, 0);
  sweep.to = sweep.from + Vector3d(0.5, 0, 0);
  EXPECT_EQ(firstTouch(scene, sweep, 0.06).outcome, TouchOutcome::Uncertain);
}

TEST(FirstTouch, AgreesWithDenseSampling) {
  const std::vector<Triangle> clutter = randomClutter(200, 3);
  const ReferenceScene scene(clutter);
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
      return oracleDistance(clutter, axis.a, axis.b) - 0.03;
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
    EXPECT_LE(separation(touch.t), 2.0 * tools::kReferenceSeparation) << i;
  }
  EXPECT_GT(touching, judged * 2 / 10);
  EXPECT_LT(touching, judged * 9 / 10);
  EXPECT_GT(judged, kCases / 2);
}

}  // namespace
}  // namespace foretouch::test
