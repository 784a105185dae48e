// tests/judge/distance_test.cpp: the oracle's distance against fifty digits, against dense
// sampling, and against the plane that proves it.
#include "judge/distance.h"

#include <gtest/gtest.h>

#include "judge/plain_distance.h"
#include "judge/scene.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;
using test::RandomPair;

struct Pair {
  Vec3d a, b;
  Triangle v;
  double size = 0;

  explicit Pair(const RandomPair& pair) : a(Vec3d(pair.a)), b(Vec3d(pair.b)) {
    for (std::size_t i = 0; i < 3; ++i) v[i] = Vec3d(pair.v[i]);
    for (const Vec3d& p : {a, b, v[0], v[1], v[2]}) size = std::max(size, extent(p));
  }
  template <typename S>
  [[nodiscard]] Closest<S> closest() const {
    return closestPoints(a.as<S>(), b.as<S>(), cornersOf<S>(v));
  }
};

constexpr int kDraws = 20'000;

Pair drawnPair(int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  const double size = random.magnitude(1e-3, 1e2);
  return Pair(randomPair(random, size, Eigen::Vector3d::Zero()));
}

TEST(OracleDistance, AgreesWithFiftyDigits) {
  long double worst = 0.0L, worstInDouble = 0.0L;
  int pierced = 0, degenerate = 0;
  for (int i = 0; i < kDraws; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-3, 1e2);
    const Pair p(randomPair(random, size, Eigen::Vector3d::Zero()));
    const auto truth = static_cast<long double>(
        preciseDistance(p.a.as<Precise>(), p.b.as<Precise>(), cornersOf<Precise>(p.v)));
    const long double error = std::abs(p.closest<Real>().distance - truth) / p.size;
    const long double errorInDouble = std::abs(p.closest<double>().distance - truth) / p.size;
    // The judge counts on these two: 1e-17 is far inside kSoundGuard, 5e-14 inside kDoubleMargin.
    ASSERT_LT(error, 1e-17L) << "case " << i;
    ASSERT_LT(errorInDouble, 5e-14L) << "case " << i;
    worst = std::max(worst, error);
    worstInDouble = std::max(worstInDouble, errorInDouble);
    pierced += truth == 0.0L;
    const auto normal = cross(p.v[1] - p.v[0], p.v[2] - p.v[0]);
    degenerate += norm(normal) < 1e-9 * p.size * p.size || norm(p.b - p.a) == 0.0;
  }
  RecordProperty("worstShare", std::to_string(static_cast<double>(worst)));
  std::cout << "worst error over size: " << worst << " in long double, " << worstInDouble
            << " in double\n";
  EXPECT_GT(pierced, kDraws / 50);
  EXPECT_GT(degenerate, kDraws / 10);
}

TEST(OracleDistance, IsProvedByAPlaneBetweenTheTwo) {
  int proved = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Pair p = drawnPair(i);
    const auto c = p.closest<Real>();
    ASSERT_NEAR(static_cast<double>(norm(c.onSegment - c.onTriangle) - c.distance), 0.0,
                1e-17 * p.size);
    if (c.distance < 1e-6L * p.size) continue;  // the direction of the plane loses its digits
    const Vec3r n = (1 / c.distance) * (c.onSegment - c.onTriangle);
    const auto height = [&n](const Vec3d& v) { return dot(n, v.as<Real>()); };
    const Real low = std::min(height(p.a), height(p.b));
    const Real high = std::max({height(p.v[0]), height(p.v[1]), height(p.v[2])});
    ASSERT_NEAR(static_cast<double>((low - high - c.distance) / p.size), 0.0, 1e-11)
        << "case " << i;
    ++proved;
  }
  EXPECT_GT(proved, kDraws / 2);
}

TEST(OracleDistance, IsNeverAboveNorFarBelowDenseSamples) {
  constexpr int kGrid = 24;
  for (int i = 0; i < 400; ++i) {
    const Pair p = drawnPair(i);
    Real least = Box::kEmpty;
    for (int s = 0; s <= kGrid; ++s) {
      const Vec3d x = p.a + (static_cast<double>(s) / kGrid) * (p.b - p.a);
      for (int j = 0; j <= kGrid; ++j) {
        for (int k = 0; j + k <= kGrid; ++k) {
          const Vec3d y = p.v[0] + (static_cast<double>(j) / kGrid) * (p.v[1] - p.v[0]) +
                          (static_cast<double>(k) / kGrid) * (p.v[2] - p.v[0]);
          least = std::min<Real>(least, norm(x - y));
        }
      }
    }
    const Real distance = p.closest<Real>().distance;
    EXPECT_LE(distance, least + 1e-15 * p.size) << "case " << i;
    // No point of either is farther from its nearest sample than one cell's sides.
    const double cell = (norm(p.b - p.a) + norm(p.v[1] - p.v[0]) + norm(p.v[2] - p.v[0])) / kGrid;
    EXPECT_GE(distance, least - cell) << "case " << i;
  }
}

TEST(OracleScene, FindsTheSameTrianglesAsALoop) {
  int meetings = 0;
  for (int i = 0; i < 60; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    std::vector<Triangle> triangles;
    for (int k = 0; k < 300; ++k) {
      const double size = random.magnitude(1e-3, 2.0);
      triangles.push_back(Pair(randomPair(random, size, random.inBox(3.0))).v);
    }
    const Scene scene(triangles);
    Box box;
    box.add(Vec3d(random.inBox(3.0)));
    box.add(Vec3d(random.inBox(3.0)));
    std::vector<int> found, expected;
    ASSERT_TRUE(scene.collect(box, triangles.size(), found));
    for (int k = 0; k < 300; ++k) {
      if (scene.boxOf(k).meets(box)) expected.push_back(k);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << "case " << i;
    meetings += !expected.empty();
  }
  EXPECT_GT(meetings, 30);
}

}  // namespace
}  // namespace foretouch::oracle
