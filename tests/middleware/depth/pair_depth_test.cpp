// The closed forms against the judge's 40,000 directions, and their ways out against its distances.
#include "middleware/depth/pair_depth.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/middleware/depth/depth_pieces.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::DepthPiece;
using oracle::Real;
using oracle::Vec3r;

constexpr int kDirections = 40'000;
/// Two neighbouring directions of so many are not farther apart (rad).
constexpr Real kSpacing = 0.02L;

const std::vector<Vec3r>& directions() {
  static const std::vector<Vec3r> all = oracle::evenDirections(kDirections);
  return all;
}

struct Judged {
  Real least;   // of the directions
  Real extent;  // of the pair, which bounds how much neighbouring directions differ
};

Judged judge(const DepthPiece& one, const DepthPiece& other) {
  Judged judged{oracle::leastToPart(one, other, directions()),
                static_cast<Real>(one.radius) + other.radius};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto x = static_cast<std::size_t>(std::min(i, one.count - 1));
      const auto y = static_cast<std::size_t>(std::min(j, other.count - 1));
      judged.extent = std::max(
          judged.extent, oracle::norm((one.corners[x] - other.corners[y]).template as<Real>()));
    }
  }
  return judged;
}

struct Seen {
  int deep = 0, apart = 0;
  double widest = 0.0;  // gap of the bounds, relative to the extent
};

void check(const PairDepth& depth, const DepthPiece& one, const DepthPiece& other, Seen& seen) {
  const Judged judged = judge(one, other);
  const Real truthAbove = std::max(0.0L, judged.least);
  ASSERT_GE(depth.lower, 0.0);
  ASSERT_LE(depth.lower, truthAbove) << "a direction is shorter";
  ASSERT_LE(depth.lower, depth.upper);
  ASSERT_GE(static_cast<Real>(depth.upper) + kSpacing * judged.extent, truthAbove);
  ASSERT_GE(depth.upper, depth.wayOut.norm() * (1.0 - 1e-15));
  // The way is proven, so it is clear; where nothing was to be done, they may touch to rounding.
  const Real after = oracle::separationAfter(one, oracle::Vec3d(depth.wayOut), other);
  ASSERT_GE(after, -1e-17L * judged.extent);
  const auto extent = static_cast<double>(judged.extent);
  const double gap = extent > 0.0 ? (depth.upper - depth.lower) / extent : 0.0;
  seen.widest = std::max(seen.widest, gap);
  ASSERT_LT(gap, 2e-7) << "bounds that are not near each other prove too little";
  (depth.upper > 0.0 ? seen.deep : seen.apart) += 1;
}

Lss randomLss(test::Random& random, double size) {
  return {random.inBox(size), random.inBox(size), random.magnitude(1e-3, 1.0) * size};
}

TEST(PairDepth, OfTwoLssAgreesWithFortyThousandDirections) {
  Seen seen;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-3, 10.0);
    Lss one = randomLss(random, size), other = randomLss(random, size);
    switch (random.below(10)) {
      case 0: other = {one.a, one.b, other.radius}; break;  // the same axis
      case 1: other.b = other.a + (one.b - one.a); break;   // parallel
      case 2:
        other.a = one.a + 0.25 * (one.b - one.a);  // on its line
        other.b = one.a + 2.0 * (one.b - one.a);
        break;
      case 3: one.b = one.a; break;                      // a ball
      case 4: one.b = one.a = other.a = other.b; break;  // one centre
      case 5: {                                          // crossing
        const Vector3d at = 0.5 * (one.a + one.b), d = random.inBox(size);
        other.a = at - d;
        other.b = at + d;
        break;
      }
      case 6:  // nearly parallel, crossing
        other.a = one.a + random.magnitude(1e-14, 1e-3) * random.inBox(size);
        other.b = one.b + random.magnitude(1e-14, 1e-3) * random.inBox(size);
        break;
      case 7: one.radius = other.radius = 0.0; break;
      default: break;
    }
    check(depthOf(one, other), test::pieceOf(one), test::pieceOf(other), seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.deep, 150);
  EXPECT_GT(seen.apart, 40);
}

/// Axes through the triangle, in its plane, along its edges, and none of these.
Lss axisFor(test::Random& random, const Triangle& triangle, double size) {
  const auto& v = triangle.vertices;
  const Vector3d inside = 0.5 * v[0] + 0.3 * v[1] + 0.2 * v[2];
  Lss lss = randomLss(random, size);
  const Vector3d d = random.inBox(size);
  switch (random.below(8)) {
    case 0:
    case 1: lss.a = inside - d, lss.b = inside + random.uniform(0.0, 1.0) * d; break;
    case 2: lss.a = inside, lss.b = inside + 0.5 * (v[1] - v[0]); break;  // in its plane
    case 3:                                                               // nearly
      lss.a = inside - 0.5 * (v[2] - v[0]) + random.magnitude(1e-15, 1e-3) * d;
      lss.b = inside + 0.5 * (v[2] - v[0]) - random.magnitude(1e-15, 1e-3) * d;
      break;
    case 4: lss.a = v[0], lss.b = v[1]; break;          // an edge
    case 5: lss.a = lss.b = inside; break;              // a ball on it
    case 6: lss.a = v[0] - d, lss.b = v[0] + d; break;  // through a corner
    default: break;
  }
  return lss;
}

TEST(PairDepth, OfAnLssAndATriangleAgreesWithFortyThousandDirections) {
  Seen seen;
  for (int i = 0; i < 800; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const double size = random.magnitude(1e-3, 10.0);
    const test::RandomPair p = test::randomPair(random, size, Vector3d::Zero());
    const Triangle triangle{p.v};
    Lss lss = i % 3 == 0 ? Lss{p.a, p.b, random.magnitude(1e-3, 1.0) * size}
                         : axisFor(random, triangle, size);
    if (random.chance(0.1)) lss.radius = 0.0;
    check(depthOf(lss, triangle), test::pieceOf(lss), test::pieceOf(triangle), seen);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.deep, 400);
  EXPECT_GT(seen.apart, 50);
}

TEST(PairDepth, OfSimpleCasesIsWhatOneSees) {
  // Two balls of 1 m, centres 0.5 m apart.
  const PairDepth balls =
      depthOf(Lss{{0, 0, 0}, {0, 0, 0}, 1.0}, Lss{{0.5, 0, 0}, {0.5, 0, 0}, 1.0});
  EXPECT_NEAR(balls.lower, 1.5, 1e-14);
  EXPECT_NEAR(balls.upper, 1.5, 1e-11);
  EXPECT_NEAR(balls.wayOut.x(), -1.5, 1e-11);
  // A post of 2 m that stands 0.3 m deep in a wide floor leaves it upwards.
  const Triangle floor{{Vector3d(-100, 0, -100), Vector3d(100, 0, -100), Vector3d(0, 0, 100)}};
  const PairDepth post = depthOf(Lss{{0, -0.2, 0}, {0, 1.8, 0}, 0.1}, floor);
  EXPECT_NEAR(post.lower, 0.3, 1e-11);
  EXPECT_NEAR(post.upper, 0.3, 1e-11);
  EXPECT_NEAR(post.wayOut.y(), 0.3, 1e-11);
  // Apart, and touching in a point.
  EXPECT_EQ(depthOf(Lss{{0, 0, 0}, {1, 0, 0}, 0.1}, Lss{{0, 1, 0}, {1, 1, 0}, 0.1}).upper, 0.0);
  EXPECT_EQ(depthOf(Lss{{0, 1, 0}, {0, 1, 0}, 0.0}, floor).upper, 0.0);
  EXPECT_LT(depthOf(Lss{{0, 0.5, 0}, {0, 0.5, 0}, 0.5}, floor).upper, 1e-11);
}

TEST(PairDepth, UncertainPlacesWidenTheBounds) {
  const Lss one{{0, 0, 0}, {1, 0, 0}, 0.5}, other{{0, 0.4, 0.3}, {1, 0.4, 0.3}, 0.5};
  const PairDepth exact = depthOf(one, other), rough = depthOf(one, other, 0.01);
  EXPECT_NEAR(rough.lower, exact.lower - 0.02, 1e-12);
  EXPECT_NEAR(rough.upper, exact.upper + 0.02, 1e-11);
  EXPECT_EQ(depthOf(one, other, 10.0).lower, 0.0);
}

TEST(PairDepth, FarFromTheOriginTheBoundsStayNearEachOther) {
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d far = random.inBox(1e6);
    const test::RandomPair p = test::randomPair(random, 1.0, far);
    const PairDepth depth = depthOf(Lss{p.a, p.b, 0.4}, Triangle{p.v});
    EXPECT_LE(depth.lower, depth.upper);
    EXPECT_LT(depth.upper - depth.lower, 1e-6);
  }
}

}  // namespace
}  // namespace foretouch
