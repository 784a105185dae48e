#include <gtest/gtest.h>

#include "middleware/exact/triangles_meet.h"
#include "tests/middleware/reference/leaf_samples.h"

namespace foretouch::test {
namespace {

using MovingTriangle = std::array<LinearPoint, 3>;

const MovingTriangle kFloorOfPairs = {still(0, 0, 0), still(4, 0, 0), still(0, 4, 0)};

MovingTriangle shifted(const std::array<Eigen::Vector3d, 3>& at, const Eigen::Vector3d& by) {
  return {LinearPoint{at[0], at[0] + by}, LinearPoint{at[1], at[1] + by},
          LinearPoint{at[2], at[2] + by}};
}

void expectFeature(const Feature& feature, FeatureKind kind, int index) {
  EXPECT_EQ(feature.kind, kind);
  EXPECT_EQ(feature.index, index);
}

TEST(TrianglePair, AVertexThatFallsOnAFaceIsNamed) {
  const auto answer =
      trianglePair(shifted({{{1, 1, 1}, {1, 1, 3}, {2, 1, 3}}}, {0, 0, -2}), kFloorOfPairs);
  ASSERT_TRUE(answer.leaf.hits);
  EXPECT_FALSE(answer.startsInContact);
  EXPECT_LE(answer.leaf.toiLow, 0.5);
  EXPECT_GE(answer.leaf.toiHigh, 0.5);
  expectFeature(answer.one, FeatureKind::Vertex, 0);
  expectFeature(answer.other, FeatureKind::Face, 0);
}

TEST(TrianglePair, EdgesThatCrossAreNamed) {
  // Edge 1 of the mover (vertices 1, 2) comes over edge 0 of the floor.
  const auto answer =
      trianglePair(shifted({{{1, -2, 5}, {1, -1, 1}, {1, 1, 2}}}, {0, 0, -3}), kFloorOfPairs);
  ASSERT_TRUE(answer.leaf.hits);
  EXPECT_LE(answer.leaf.toiLow, 0.5);
  EXPECT_GE(answer.leaf.toiHigh, 0.5);
  expectFeature(answer.one, FeatureKind::Edge, 1);
  expectFeature(answer.other, FeatureKind::Edge, 0);
}

TEST(TrianglePair, PiercedAtTheStartIsInContactThen) {
  const auto answer =
      trianglePair(shifted({{{1, 1, 1}, {1, 1, -1}, {9, 9, 1}}}, {0, 0, 5}), kFloorOfPairs);
  EXPECT_TRUE(answer.startsInContact);
  ASSERT_TRUE(answer.leaf.hits);
  EXPECT_EQ(answer.leaf.toiLow, 0.0);
  EXPECT_EQ(answer.leaf.toiHigh, 0.0);
}

TEST(TrianglePair, FarApartThroughoutIsFree) {
  const auto answer =
      trianglePair(shifted({{{1, 1, 1}, {1, 1, 3}, {2, 1, 3}}}, {9, 0, 0}), kFloorOfPairs);
  EXPECT_FALSE(answer.leaf.hits);
  EXPECT_FALSE(answer.startsInContact);
}

TEST(TrianglePair, IsTheSameSeenFromTheOtherAndFreeBeforeItsTime) {
  constexpr int kCases = 1500;
  int hits = 0, starts = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    MovingTriangle one, other;
    for (int i = 0; i < 3; ++i) {
      const FourPoints points = onLattice(random, 3);
      one[i] = points[0];
      other[i] = points[1];
    }
    const auto answer = trianglePair(one, other), mirrored = trianglePair(other, one);
    ASSERT_EQ(answer.leaf.hits, mirrored.leaf.hits);
    EXPECT_EQ(answer.startsInContact, mirrored.startsInContact);
    EXPECT_LE(answer.leaf.toiLow, mirrored.leaf.toiHigh);
    hits += answer.leaf.hits;
    starts += answer.startsInContact;
    for (int k = 0; k < 8; ++k) {  // sampled times are dyadic, so the sampled triangles are exact
      const double t = k / 8.0;
      Triangle a, b;
      for (int i = 0; i < 3; ++i) {
        a.vertices[i] = one[i].from + t * (one[i].to - one[i].from);
        b.vertices[i] = other[i].from + t * (other[i].to - other[i].from);
      }
      const bool free = !answer.leaf.hits || t < answer.leaf.toiLow;
      if (free) {
        ASSERT_FALSE(trianglesMeet(a, b)) << "t " << t;
      }
    }
  }
  EXPECT_GT(hits - starts, kCases / 20);
  EXPECT_LT(hits, kCases);
  EXPECT_GT(starts, 0);
}

}  // namespace
}  // namespace foretouch::test
