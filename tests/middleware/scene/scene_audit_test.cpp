// auditScene(): counts and measures against brute force and arithmetic without rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "judge/precise.h"
#include "middleware/scene/scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Exact;

RawScene sceneOf(std::vector<Triangle> triangles) {
  RawScene scene;
  scene.triangles = std::move(triangles);
  scene.objectOf.assign(scene.triangles.size(), 0);
  scene.objectNames = {"object"};
  return scene;
}

Triangle triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return {{a, b, c}};
}

/// The cross product of two edges without rounding: zero exactly where the corners are on a
/// line.
bool onOneLine(const Triangle& t) {
  const auto edge = [&](std::size_t k, int axis) {
    return Exact(t.vertices[k][axis]) - Exact(t.vertices[0][axis]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (edge(1, u) * edge(2, v) != edge(1, v) * edge(2, u)) return false;
  }
  return true;
}

bool hasZeroArea(const Triangle& t) {
  return auditScene(sceneOf({t})).zeroArea == 1;
}

TEST(AuditScene, CountsAndMeasuresASmallScene) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const SceneAudit audit = auditScene(sceneOf({
      triangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0}),
      triangle({0, 4, 0}, {0, 0, 0}, {3, 0, 0}),            // the same one, turned
      triangle({0, 0, 0}, {0, 0, 0.25}, {0, 0, -2}),        // on a line
      triangle({kNan, 0, 0}, {900, 0, 0}, {0, 900, 0}),     // dropped
      triangle({0, 0, 0}, {0, kInfinity, 0}, {0, 0, 900}),  // dropped
      triangle({-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}),   // a point
  }));
  EXPECT_EQ(audit.triangles, 4U);
  EXPECT_EQ(audit.droppedNonFinite, 2U);
  EXPECT_EQ(audit.zeroArea, 2U);
  EXPECT_EQ(audit.duplicates, 1U);
  EXPECT_EQ(audit.boxMin, Vector3d(-1, -1, -2));
  EXPECT_EQ(audit.boxMax, Vector3d(3, 4, 0.25));
  EXPECT_EQ(audit.shortestEdge, 0.25);
  EXPECT_EQ(audit.longestEdge, 5.0);
}

TEST(AuditScene, IsAllZeroWithoutFiniteTriangles) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const RawScene& scene :
       {RawScene{}, sceneOf({triangle({kNan, 0, 0}, {1, 0, 0}, {0, 1, 0})})}) {
    const SceneAudit audit = auditScene(scene);
    EXPECT_EQ(audit.triangles, 0U);
    EXPECT_EQ(audit.droppedNonFinite, scene.triangles.size());
    EXPECT_EQ(audit.boxMin, Vector3d(0, 0, 0));
    EXPECT_EQ(audit.boxMax, Vector3d(0, 0, 0));
    EXPECT_EQ(audit.shortestEdge, 0.0);
    EXPECT_EQ(audit.longestEdge, 0.0);
  }
}

TEST(AuditScene, DecidesZeroAreaLikeExactArithmetic) {
  int onLine = 0, offLine = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::uniform_int_distribution<int> digits(3, 53), steps(-6, 6), exponent(-400, 400);
    // With few digits the third point lands on the line without rounding; with many it misses it
    // by a last digit, which no computed area would tell.
    const double grid = std::ldexp(1.0, digits(random) / 2);
    const auto any = [&] { return std::round(unit(random) * grid) / grid; };
    const Vector3d a(any(), any(), any()), step(any(), any(), any());
    const double scale = std::ldexp(1.0, seed % 3 == 0 ? exponent(random) : 0);
    Triangle t = triangle(a * scale, (a + step) * scale, (a + steps(random) * step) * scale);
    if (seed % 4 == 1) {
      double& coordinate = t.vertices[2][static_cast<int>(random() % 3)];
      coordinate = std::nextafter(coordinate, 10.0);
    }
    std::shuffle(t.vertices.begin(), t.vertices.end(), random);
    const bool expected = onOneLine(t);
    ASSERT_EQ(hasZeroArea(t), expected) << "seed " << seed;
    (expected ? onLine : offLine) += 1;
  }
  EXPECT_GT(onLine, 5000);
  EXPECT_GT(offLine, 4000);
}

TEST(AuditScene, DecidesZeroAreaFromEndToEndOfTheDoubles) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kMost = std::numeric_limits<double>::max();
  const std::vector<double> values = {0.0,   kLeast, -kLeast,   3 * kLeast, 1e-200, -1e-200,
                                      1.0,   -1.0,   1e-16,     0.1,        1e200,  -1e200,
                                      kMost, -kMost, kMost / 2, 1 / 3.0};
  int onLine = 0;
  for (unsigned seed = 0; seed < 5000; ++seed) {
    std::mt19937 random(seed);
    Triangle t;
    for (Vector3d& v : t.vertices) {
      for (int axis = 0; axis < 3; ++axis) {
        v[axis] = values[random() % (axis == 2 ? 2 : values.size())];
      }
    }
    // Half of them in one plane through the axis y = x, where lines are frequent.
    if (seed % 2 == 0) {
      for (Vector3d& v : t.vertices) v.y() = v.x();
    }
    ASSERT_EQ(hasZeroArea(t), onOneLine(t)) << "seed " << seed;
    onLine += onOneLine(t);
  }
  EXPECT_GT(onLine, 500);
  EXPECT_LT(onLine, 4500);
}

TEST(AuditScene, DecidesZeroAreaWhereProductsUnderflow) {
  int onLine = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    std::mt19937_64 random(seed);
    // Points t * (1, 3, 5): exact, as t has 50 bits; but their differences round, and the products
    // of those have few digits left.
    const int exponent = -500 - static_cast<int>(random() % 50);
    Triangle t;
    for (Vector3d& v : t.vertices) {
      const auto bits = static_cast<double>(random() >> 14);
      const double place = std::ldexp(bits, exponent - 20 - static_cast<int>(random() % 40));
      v = Vector3d(place, 3 * place, 5 * place);
    }
    if (seed % 4 == 0) t.vertices[seed % 3].y() = std::nextafter(t.vertices[seed % 3].y(), 1.0);
    ASSERT_EQ(hasZeroArea(t), onOneLine(t)) << "seed " << seed;
    onLine += onOneLine(t);
  }
  EXPECT_GE(onLine, 3000);
  EXPECT_LT(onLine, 3100);
}

TEST(AuditScene, CountsDuplicatesLikeASetOfPointSets) {
  std::size_t found = 0;
  constexpr std::array<double, 3> pick = {0.0, 1.0, 0.1};
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    std::vector<Triangle> triangles(1 + random() % 200);
    for (Triangle& t : triangles) {
      for (Vector3d& v : t.vertices) {
        v = Vector3d(pick[random() % 2], pick[random() % 3], pick[random() % 2]);
        if (random() % 2 == 0) v.z() = -v.z();  // -0 and 0 are the same place
      }
    }
    std::set<std::vector<std::array<double, 3>>> seen;
    std::size_t expected = 0;
    for (const Triangle& t : triangles) {
      std::vector<std::array<double, 3>> points;
      for (const Vector3d& v : t.vertices) points.push_back({v.x(), v.y(), v.z()});
      std::sort(points.begin(), points.end());
      expected += !seen.insert(points).second;
    }
    ASSERT_EQ(auditScene(sceneOf(triangles)).duplicates, expected) << seed;
    found += expected;
  }
  EXPECT_GT(found, 1500U);
}

TEST(AuditScene, CallsNoTriangleADuplicateThatDiffersByALastDigit) {
  std::vector<Triangle> triangles;
  double x = 0.1;
  for (int i = 0; i < 1000; ++i, x = std::nextafter(x, 1.0)) {
    triangles.push_back(triangle({x, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  }
  EXPECT_EQ(auditScene(sceneOf(triangles)).duplicates, 0U);
  triangles.push_back(triangles[500]);
  EXPECT_EQ(auditScene(sceneOf(triangles)).duplicates, 1U);
}

TEST(AuditScene, CountsEveryFurtherCopyOfATriangle) {
  const std::vector<Triangle> copies(100000, triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  EXPECT_EQ(auditScene(sceneOf(copies)).duplicates, copies.size() - 1);
}

TEST(AuditScene, MeasuresEdgesThatSquaresCannotHold) {
  const SceneAudit audit = auditScene(sceneOf({triangle({0, 0, 0}, {3e-200, 4e-200, 0}, {0, 0, 0}),
                                               triangle({0, 0, 0}, {3e200, 4e200, 0}, {0, 0, 0})}));
  EXPECT_DOUBLE_EQ(audit.shortestEdge, 5e-200);
  EXPECT_DOUBLE_EQ(audit.longestEdge, 5e200);
}

}  // namespace
}  // namespace foretouch
