// Sums and chains with corners on so coarse a lattice that ties, flat and collinear corners are the
// rule.
#include "tessellation/swept_chain.h"

#include <gtest/gtest.h>

#include "tests/tessellation/surface_checks.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

LatticePoint coarsePoint(Random& random, int half) {
  const auto draw = [&] { return static_cast<std::int64_t>(random.below(2 * half + 1) - half); };
  return {draw(), draw(), draw()};
}

Vector3d asVector(const LatticePoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// Instants whose ends often stand still, coincide, reverse or stay in a plane.
std::vector<LatticeEnds> coarsePath(Random& random, int instants) {
  std::vector<LatticeEnds> path;
  const int half = 1 + random.below(6);
  const bool isFlat = random.chance(0.4), isSphere = random.chance(0.15);
  for (int i = 0; i < instants; ++i) {
    LatticeEnds ends{coarsePoint(random, half), coarsePoint(random, half)};
    if (isFlat) ends.a.z = ends.b.z = 0;
    if (i > 0 && random.chance(0.25)) ends.a = path.back().a;
    if (i > 0 && random.chance(0.25)) ends.b = path.back().b;
    if (i > 1 && random.chance(0.2)) ends = path[path.size() - 2];
    if (isSphere) ends.b = ends.a;
    path.push_back(ends);
  }
  return path;
}

SweptSurface surfaceOf(SweptChain& chain) {
  chain.close();
  const ClosedMesh mesh = chain.mesh();
  SweptSurface surface;
  surface.spacing = 1.0;
  surface.triangles = mesh.triangles;
  for (const ClosedMesh::Vertex& v : mesh.vertices) {
    surface.vertices.push_back(0.5 * asVector(chain.place(v.a) + chain.place(v.b)));
  }
  return surface;
}

SweptSurface chained(const BallPolytope& polytope, const std::vector<LatticeEnds>& path) {
  SweptChain chain(polytope, path[0], 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) chain.add(path[i], static_cast<double>(i));
  return surfaceOf(chain);
}

BallPolytope coarseBall(Random& random) {
  const double radius = 8.0 + random.uniform(0, 30);
  return polytopeAround(radius, radius * random.magnitude(0.1, 0.6) + 4.0).value();
}

// All sums of a corner and a polytope's corner lie below or on every face, in whole numbers; with
// a closed surface of positive volume that makes it the sum's boundary.
TEST(SweptChain, OfOnePieceIsTheBoundaryOfTheSum) {
  int faces = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const BallPolytope ball = coarseBall(random);
    const auto path = coarsePath(random, 2);
    const SweptSurface surface = chained(ball, path);
    ASSERT_EQ(looseEdges(surface), 0u);
    ASSERT_EQ(brokenRings(surface), 0u);
    ASSERT_GT(volumeOf(surface), 0.0);
    for (const auto& t : surface.triangles) {
      // Small whole numbers and halves: doubles hold all of this exactly.
      const Vector3d origin = surface.vertices[t[0]];
      const Vector3d normal =
          (surface.vertices[t[1]] - origin).cross(surface.vertices[t[2]] - origin);
      faces += normal.squaredNorm() > 0.0;
      double highest = -1e300;
      for (const LatticePoint& corner : ball.corners) {
        highest = std::max(highest, normal.dot(asVector(corner)));
      }
      for (const LatticeEnds& ends : path) {
        for (const LatticePoint& end : {ends.a, ends.b}) {
          ASSERT_LE(normal.dot(asVector(end) - origin) + highest, 0.0);
        }
      }
    }
  }
  EXPECT_GT(faces, 50'000);
}

TEST(SweptChain, IsClosedAndWindsAroundEveryPieceAndNothingElse) {
  int inside = 0, outside = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const BallPolytope ball = coarseBall(random);
    const auto path = coarsePath(random, 2 + random.below(8));
    const SweptSurface surface = chained(ball, path);
    ASSERT_EQ(looseEdges(surface), 0u);
    ASSERT_EQ(brokenRings(surface), 0u);
    const Winding winding(surface);
    for (int i = 0; i < 100; ++i) {
      const auto k = static_cast<std::size_t>(random.below(static_cast<int>(path.size()) - 1));
      std::array<double, 4> weights{};
      double total = 0.0;
      for (double& w : weights) total += w = random.magnitude(1e-3, 1.0);
      const Vector3d onHull =
          (weights[0] * asVector(path[k].a) + weights[1] * asVector(path[k].b) +
           weights[2] * asVector(path[k + 1].a) + weights[3] * asVector(path[k + 1].b)) /
          total;
      const Vector3d direction = random.direction();
      ASSERT_GE(winding.at(onHull + 0.999 * ball.inradius * direction), 1);
      ++inside;
      const Vector3d p = onHull + random.uniform(0.5, 2.0) * ball.circumradius * direction;
      ASSERT_GE(winding.at(p), 0);
      // Beyond all corners along some direction, by more than the polytope's circumradius: outside.
      double farthest = -1e300;
      for (const LatticeEnds& ends : path) {
        farthest =
            std::max({farthest, direction.dot(asVector(ends.a)), direction.dot(asVector(ends.b))});
      }
      if (direction.dot(p) <= farthest + ball.circumradius) continue;
      ASSERT_EQ(winding.at(p), 0);
      ++outside;
    }
  }
  EXPECT_GT(inside, 10'000);
  EXPECT_GT(outside, 2'000);
}

TEST(BallPolytope, HoldsTheBallWithinTheExcess) {
  for (const double radius : {5.0, 100.0, 12345.6, 1e7}) {
    for (const double share : {0.9, 0.1, 1e-2, 1e-3}) {
      const double layer = radius * share + 4.0;
      const auto around = polytopeAround(radius, layer);
      ASSERT_TRUE(around.ok());
      EXPECT_GE(around.value().inradius, radius);
      EXPECT_LE(around.value().circumradius, radius + layer);
      if (layer >= radius) continue;
      const auto within = polytopeWithin(radius, layer);
      ASSERT_TRUE(within.ok());
      EXPECT_LE(within.value().circumradius, radius * (1.0 + 1e-13));
      EXPECT_GE(within.value().inradius, radius - layer);
      const auto count = static_cast<std::size_t>(around.value().frequency);
      EXPECT_EQ(around.value().facets.size(), 20 * count * count);
      EXPECT_EQ(around.value().corners.size(), 10 * count * count + 2);
    }
  }
}

// Corners that differ along a facet are equally far along its normal, and products of this size are
// no doubles: of these two the first counts, whatever rounding says.
TEST(SweptSum, LabelsAreExactWhereDoublesAreNot) {
  const BallPolytope ball = polytopeAround(1e8, 1e7).value();
  SweptSum sum(ball);
  SumFaces faces;
  std::size_t rounded = 0;
  for (std::size_t f = 0; f < ball.facets.size(); ++f) {
    const BallPolytope::Facet& facet = ball.facets[f];
    const auto corner = [&](std::size_t k) { return ball.corners[slotOf(facet.corners[k])]; };
    const LatticePoint u = corner(1) - corner(0), v = corner(2) - corner(0);
    const LatticePoint along{3 * u.x - 7 * v.x, 3 * u.y - 7 * v.y, 3 * u.z - 7 * v.z};
    ASSERT_EQ(exactDot(facet.normal, along), 0);
    rounded += asVector(facet.normal).dot(asVector(along)) != 0.0;
    for (const LatticePoint& other : {along, LatticePoint{} - along}) {
      sum.facesOf({LatticePoint{}, other}, faces);
      ASSERT_EQ(faces.facetCorner[f], 0) << f;
    }
  }
  EXPECT_GT(rounded, 10u);
}

// The regular icosahedron's corners are 1.2584 times as far out as its facets; cut once, 1.0787
// times.
TEST(BallPolytope, IsTheIcosahedronWhereItWillDo) {
  constexpr double kRadius = 1e6;
  EXPECT_EQ(polytopeAround(kRadius, 0.2585 * kRadius).value().frequency, 1);
  EXPECT_EQ(polytopeAround(kRadius, 0.2583 * kRadius).value().frequency, 2);
}

TEST(BallPolytope, RefusesMoreFacetsThanThereMayBe) {
  EXPECT_FALSE(polytopeAround(1e12, 4.0).ok());
}

TEST(LatticeSigns, OfProductsBeyondOneHundredTwentyEightBits) {
  const WideInteger big = static_cast<WideInteger>(1) << 125;
  EXPECT_EQ(signOfDifferenceOfProducts(big, big, big, big), 0);
  EXPECT_EQ(signOfDifferenceOfProducts(big, big - 1, big - 1, big), 0);
  EXPECT_EQ(signOfDifferenceOfProducts(big + 1, big - 1, big, big), -1);
  EXPECT_EQ(signOfDifferenceOfProducts(big, big, big + 1, big - 1), 1);
  EXPECT_EQ(signOfDifferenceOfProducts(3, 5, 7, 2), 1);
  EXPECT_EQ(signOfDifferenceOfProducts(0, big, 1, 1), -1);
  // (2^65 - 1)^2 is 2^66 - 1 below 2^130: carries out of all lower products.
  const WideInteger power = static_cast<WideInteger>(1) << 65;
  EXPECT_EQ(signOfDifferenceOfProducts(power - 1, power - 1, power, power), -1);
  EXPECT_EQ(signOfDifferenceOfProducts(power - 1, power - 1, power >> 1, power - 4), 1);
}

}  // namespace
}  // namespace foretouch::test
