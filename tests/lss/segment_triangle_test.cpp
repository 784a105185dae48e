#include "lss/segment_triangle.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;

const Triangle kFloor{{Vector3d(0, 0, 0), Vector3d(4, 0, 0), Vector3d(0, 0, 4)}};

TEST(ClosestPoints, AboveTheFaceIsTheHeight) {
  const ClosestPoints c = closestPoints({1, 2, 1}, {1, 3, 1}, kFloor);
  EXPECT_EQ(c.distance, 2.0);
  EXPECT_EQ(c.onSegment, Vector3d(1, 2, 1));
  EXPECT_EQ(c.onTriangle, Vector3d(1, 0, 1));
}

TEST(ClosestPoints, CrossingTheFaceIsZero) {
  EXPECT_EQ(closestPoints({1, 1, 1}, {1, -1, 1}, kFloor).distance, 0.0);
}

TEST(ClosestPoints, BeyondAnEdgeIsTheEdge) {
  const ClosestPoints c = closestPoints({1, 3, -4}, {3, 3, -4}, kFloor);
  EXPECT_DOUBLE_EQ(c.distance, 5.0);
  EXPECT_EQ(c.onTriangle.y(), 0.0);
  EXPECT_EQ(c.onTriangle.z(), 0.0);
}

TEST(ClosestPoints, CrossedEdgeAndAxisMeetInTheirInteriors) {
  const ClosestPoints c = closestPoints({2, 1, -3}, {2, 1, 0}, kFloor);
  EXPECT_DOUBLE_EQ(c.distance, 1.0);
}

TEST(ClosestPoints, ZeroLengthAndZeroAreaAreLegal) {
  const Triangle point{{Vector3d(1, 1, 1), Vector3d(1, 1, 1), Vector3d(1, 1, 1)}};
  EXPECT_DOUBLE_EQ(closestPoints({1, 1, 4}, {1, 1, 4}, point).distance, 3.0);
  const Triangle segment{{Vector3d(0, 0, 0), Vector3d(2, 0, 0), Vector3d(4, 0, 0)}};
  EXPECT_DOUBLE_EQ(closestPoints({3, 1, 0}, {3, 1, 5}, segment).distance, 1.0);
  EXPECT_DOUBLE_EQ(closestPoints({3, 0, 0}, {3, 0, 0}, segment).distance, 0.0);
}

TEST(ClosestPoints, EveryOrderOfVerticesAndEndsGivesTheSameDistance) {
  for (int i = 0; i < 2000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    test::RandomPair p = test::randomPair(random, 2.0, Vector3d::Zero());
    const double expected = closestPoints(p.a, p.b, {p.v}).distance;
    std::array<int, 3> order = {0, 1, 2};
    do {
      const Triangle t{{p.v[order[0]], p.v[order[1]], p.v[order[2]]}};
      // Two noisy answers, each within rounding of the truth unless segment and edge nearly line
      // up.
      EXPECT_NEAR(closestPoints(p.b, p.a, t).distance, expected, 1e-9) << "case " << i;
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(ClosestPoints, AgreesWithFiftyDigits) {
  int touching = 0, apart = 0;
  double worst = 0.0;
  constexpr int kCases = 20000;
  for (int i = 0; i < kCases; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = i % 4 == 0 ? Vector3d(random.inBox(1e4)) : Vector3d(Vector3d::Zero());
    const test::RandomPair p = test::randomPair(random, 2.0, center);
    const double truth = static_cast<double>(oracle::preciseDistance(
        Precise3(p.a), Precise3(p.b), {Precise3(p.v[0]), Precise3(p.v[1]), Precise3(p.v[2])}));
    const double got = closestPoints(p.a, p.b, {p.v}).distance;
    // Never below the truth by more than rounding; above it only where lines nearly coincide
    // (lss/segment_triangle.md section 3: at most about 1e-8 of the pair's extent).
    ASSERT_GE(got, truth - 1e-13) << "case " << i;
    ASSERT_LE(got, truth + 1e-7) << "case " << i;
    if (truth > 1e-3) {
      ASSERT_NEAR(got, truth, 1e-12) << "case " << i;
      worst = std::max(worst, std::abs(got - truth));
    }
    (truth < 1e-9 ? touching : apart) += 1;
  }
  RecordProperty("worst_error_when_apart_m", std::to_string(worst));
  EXPECT_GT(touching, kCases / 20);
  EXPECT_GT(apart, kCases / 2);
}

}  // namespace
}  // namespace foretouch
