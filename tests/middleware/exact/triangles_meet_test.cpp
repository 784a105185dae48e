// Whether two triangles meet, against fifty digits and against the linear queries, which decide it
// by other determinants: on lattices, where most cases are degenerate, and an ulp from touching.
#include "middleware/exact/triangles_meet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/middleware/random_scene.h"
#include "tests/reference/linear_query.h"

namespace foretouch {
namespace {

using oracle::Precise3;
using oracle::preciseDistance;
using test::Random;
using Real = oracle::Precise;

bool meetByQueries(const Triangle& one, const Triangle& other) {
  const auto atRest = [](const Triangle& triangle) {
    const auto& v = triangle.vertices;
    return std::array<LinearPoint, 3>{LinearPoint{v[0], v[0]}, LinearPoint{v[1], v[1]},
                                      LinearPoint{v[2], v[2]}};
  };
  return trianglePair(atRest(one), atRest(other)).startsInContact;
}

/// Either order, and any order of the vertices.
void expectTheSameInAnyOrder(const Triangle& one, const Triangle& other, bool met) {
  Triangle turned = one, swapped = other;
  std::rotate(turned.vertices.begin(), turned.vertices.begin() + 1, turned.vertices.end());
  std::swap(swapped.vertices[0], swapped.vertices[2]);
  EXPECT_EQ(trianglesMeet(other, one), met);
  EXPECT_EQ(trianglesMeet(turned, swapped), met);
  EXPECT_EQ(trianglesMeet(swapped, turned), met);
}

Triangle latticeTriangle(Random& random, int side) {
  Triangle triangle;
  for (auto& v : triangle.vertices) {
    for (int axis = 0; axis < 3; ++axis) v[axis] = random.below(side) - side / 2;
  }
  return triangle;
}

/// Fifty-digit distance; on a lattice two triangles that do not meet are far more than 1e-40 apart.
bool meetPrecisely(const Triangle& one, const Triangle& other) {
  Real least = 1;
  std::array<Precise3, 3> a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = Precise3(one.vertices[i]);
    b[i] = Precise3(other.vertices[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, preciseDistance(a[i], a[(i + 1) % 3], b));
    least = std::min(least, preciseDistance(b[i], b[(i + 1) % 3], a));
  }
  return least < Real("1e-20");
}

TEST(TrianglesMeet, AgreesWithFiftyDigitsOnALattice) {
  constexpr int kCases = 2000;
  int meets = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const Triangle one = latticeTriangle(random, 5), other = latticeTriangle(random, 5);
    const bool met = trianglesMeet(one, other);
    ASSERT_EQ(met, meetPrecisely(one, other));
    expectTheSameInAnyOrder(one, other, met);
    meets += met ? 1 : 0;
  }
  EXPECT_GT(meets, kCases / 10);
  EXPECT_LT(meets, kCases * 9 / 10);
}

// Points, segments, coplanar and parallel pairs: on the smallest lattices hardly a pair is anything
// else.
TEST(TrianglesMeet, AgreesWithLinearQueriesWhereNothingIsInGeneralPosition) {
  constexpr int kCases = 60000;
  int meets = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const int side = 2 + seed % 3;
    Triangle one = latticeTriangle(random, side), other = latticeTriangle(random, side);
    if (seed % 5 == 0) {  // one plane
      const int axis = random.below(3);
      for (auto& v : one.vertices) v[axis] = 1.0;
      for (auto& v : other.vertices) v[axis] = 1.0;
    }
    if (seed % 7 == 0) other.vertices[1] = other.vertices[0];
    if (seed % 11 == 0) one.vertices[2] = one.vertices[1] = one.vertices[0];
    const bool met = trianglesMeet(one, other);
    ASSERT_EQ(met, meetByQueries(one, other)) << seed;
    if (seed % 10 == 0) expectTheSameInAnyOrder(one, other, met);
    meets += met ? 1 : 0;
  }
  EXPECT_GT(meets, kCases / 10);
  EXPECT_LT(meets, kCases * 9 / 10);
}

/// Moves a coordinate by a few ulps, or not.
void nudge(Random& random, Triangle& triangle) {
  double& x = triangle.vertices[static_cast<std::size_t>(random.below(3))][random.below(3)];
  for (int k = random.below(3); k > 0; --k) {
    x = std::nextafter(x, random.chance(0.5) ? 1e9 : -1e9);
  }
}

// A vertex or an edge of one lies on the other but for rounding, near the origin and far from it.
TEST(TrianglesMeet, AgreesWithLinearQueriesAnUlpFromTouching) {
  constexpr int kCases = 20000;
  int meets = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Eigen::Vector3d place = random.chance(0.5) ? Eigen::Vector3d(1e6 * random.direction())
                                                     : Eigen::Vector3d(random.inBox(1.0));
    const double size = random.magnitude(1e-6, 10.0);
    Triangle one, other;
    for (auto& v : one.vertices) v = place + size * random.inBox(1.0);
    for (auto& v : other.vertices) v = place + size * random.inBox(1.0);
    const auto& w = one.vertices;
    const double a = random.uniform(0.0, 1.0), b = random.uniform(0.0, 1.0) * (1.0 - a);
    const Eigen::Vector3d on =
        w[0] + a * (w[1] - w[0]) + (random.chance(0.5) ? b : 0.0) * (w[2] - w[0]);
    other.vertices[0] = on;
    if (random.chance(0.3)) other.vertices[1] = on + (w[1] - w[0]) * random.uniform(0.0, 1.0);
    nudge(random, one);
    nudge(random, other);
    const bool met = trianglesMeet(one, other);
    ASSERT_EQ(met, meetByQueries(one, other)) << seed;
    expectTheSameInAnyOrder(one, other, met);
    meets += met ? 1 : 0;
  }
  EXPECT_GT(meets, kCases / 10);
  EXPECT_LT(meets, kCases * 9 / 10);
}

TEST(TrianglesMeet, KnowsWhatOnlyJustTouches) {
  const Triangle floor{
      {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 0, 0), Eigen::Vector3d(0, 4, 0)}};
  const auto at = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return Triangle{{a, b, c}};
  };
  const double above = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(trianglesMeet(floor, at({1, 1, 0}, {1, 1, 2}, {2, 1, 2}))) << "a vertex on the face";
  EXPECT_FALSE(trianglesMeet(floor, at({1, 1, above}, {1, 1, 2}, {2, 1, 2}))) << "just above it";
  EXPECT_TRUE(trianglesMeet(floor, at({4, 0, 0}, {5, 0, 0}, {5, 1, 1}))) << "vertex on vertex";
  EXPECT_TRUE(trianglesMeet(floor, at({2, -1, 0}, {2, 0, 0}, {3, -1, 0})))
      << "in its plane, an edge";
  EXPECT_FALSE(trianglesMeet(floor, at({3, 2, 0}, {4, 2, 0}, {4, 3, 0}))) << "in its plane, beside";
  EXPECT_TRUE(trianglesMeet(floor, at({1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}))) << "inside it";
  EXPECT_TRUE(trianglesMeet(floor, at({1, 1, 0}, {1, 1, 0}, {1, 1, 0}))) << "a point of it";
  EXPECT_FALSE(trianglesMeet(floor, at({1, 1, 1}, {1, 1, 1}, {1, 1, 1}))) << "a point above it";
  EXPECT_TRUE(
      trianglesMeet(at({0, 0, 0}, {2, 2, 2}, {1, 1, 1}), at({2, 2, 2}, {3, 3, 3}, {2, 2, 2})))
      << "segments on one line, end to end";
  EXPECT_FALSE(
      trianglesMeet(at({0, 0, 0}, {2, 2, 2}, {1, 1, 1}), at({3, 3, 3}, {4, 4, 4}, {3, 3, 3})));
}

}  // namespace
}  // namespace foretouch
