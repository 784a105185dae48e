// tests/judge/rational_linear_test.cpp: the linear oracle on closed forms, on every degenerate
// case by name, filter against rationals, and on labelled public queries.
#include "judge/rational_linear.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/oracle/leaf_campaign.h"

namespace foretouch::oracle {
namespace {

using test::Random;

Path still(Vec3d p) {
  return {p, p};
}

LinearQuery vertexFace(Path v, Path a, Path b, Path c) {
  return {LinearKind::VertexFace, {v, a, b, c}};
}
LinearQuery edgeEdge(Path a, Path b, Path c, Path d) {
  return {LinearKind::EdgeEdge, {a, b, c, d}};
}

void expectHitAt(const LinearQuery& query, double t) {
  for (const LinearTruth& truth : {linearTruth(query), linearTruthByRationals(query)}) {
    ASSERT_TRUE(truth.hits) << test::inHex(query);
    EXPECT_LE(truth.low, t);
    EXPECT_GE(truth.high, t);
    EXPECT_LE(truth.high - truth.low, kTruthWidth);
  }
}
void expectMiss(const LinearQuery& query) {
  EXPECT_FALSE(linearTruth(query).hits) << test::inHex(query);
  EXPECT_FALSE(linearTruthByRationals(query).hits) << test::inHex(query);
}

const Path kA = still({0, 0, 0}), kB = still({4, 0, 0}), kC = still({0, 4, 0});

TEST(LinearTruth, TimesAVertexThatFallsThroughAFace) {
  expectHitAt(vertexFace({{1, 1, 1}, {1, 1, -3}}, kA, kB, kC), 0.25);
  expectHitAt(vertexFace({{1, 1, 3}, {1, 1, 0}}, kA, kB, kC), 1.0);   // only at the end
  expectHitAt(vertexFace({{1, 1, 0}, {1, 1, 3}}, kA, kB, kC), 0.0);   // only at the start
  expectHitAt(vertexFace({{2, 2, 1}, {2, 2, -1}}, kA, kB, kC), 0.5);  // on an edge
  expectHitAt(vertexFace({{4, 0, 1}, {4, 0, -1}}, kA, kB, kC), 0.5);  // on a vertex
  expectMiss(vertexFace({{1, 1, 3}, {1, 1, 0x1p-60}}, kA, kB, kC));   // stops short
  expectMiss(vertexFace({{2, 2 + 0x1p-50, 1}, {2, 2 + 0x1p-50, -1}}, kA, kB, kC));  // passes by
}

TEST(LinearTruth, FollowsAVertexThatStaysInTheFacesPlane) {
  expectHitAt(vertexFace({{-1, 1, 0}, {3, 1, 0}}, kA, kB, kC), 0.25);
  expectHitAt(vertexFace({{8, 0, 0}, {0, 8, 0}}, kA, kB, {{0, 4, 0}, {0, 8, 0}}), 1.0);
  expectMiss(vertexFace({{8, 0, 0}, {0, 8, 0}}, kA, kB, kC));
  expectHitAt(vertexFace({{1, 1, 0}, {9, 9, 0}}, kA, kB, kC), 0.0);
}

TEST(LinearTruth, SeesFacesWithoutArea) {
  const Path middle = still({2, 0, 0});
  expectHitAt(vertexFace({{1, 1, 0}, {1, -3, 0}}, kA, middle, kB), 0.25);
  expectMiss(vertexFace({{5, 1, 0}, {5, -3, 0}}, kA, middle, kB));
  expectHitAt(vertexFace({{0, 1, 0}, {0, -1, 0}}, kA, kA, kA), 0.5);
  expectMiss(vertexFace({{0x1p-40, 1, 0}, {0x1p-40, -1, 0}}, kA, kA, kA));
  // No area at the instant of contact only: the apex falls through the base at t = 1/2.
  expectHitAt(vertexFace({{2, 0, 1}, {2, 0, -1}}, kA, kB, {{2, 1, 0}, {2, -1, 0}}), 0.5);
  expectMiss(vertexFace({{5, 0, 1}, {5, 0, -1}}, kA, kB, {{2, 1, 0}, {2, -1, 0}}));
}

TEST(LinearTruth, TimesCrossingEdges) {
  const Path left{{-1, 0, 1}, {-1, 0, -3}}, right{{1, 0, 1}, {1, 0, -3}};
  expectHitAt(edgeEdge(left, right, still({0, -1, 0}), still({0, 1, 0})), 0.25);
  expectHitAt(edgeEdge(left, right, still({1, 0, 0}), still({1, 1, 0})), 0.25);  // end to end
  expectMiss(edgeEdge(left, right, still({1 + 0x1p-52, 0, 0}), still({2, 1, 0})));
}

TEST(LinearTruth, SeesParallelCollinearAndPointLikeEdges) {
  const Path left{{-1, 0, 1}, {-1, 0, -1}}, right{{1, 0, 1}, {1, 0, -1}};
  expectHitAt(edgeEdge(left, right, still({0, 0, 0}), still({3, 0, 0})), 0.5);
  expectHitAt(edgeEdge(left, right, still({1, 0, 0}), still({3, 0, 0})), 0.5);
  expectMiss(edgeEdge(left, right, still({2, 0, 0}), still({3, 0, 0})));
  expectHitAt(edgeEdge(left, right, still({0, 0, 0}), still({0, 0, 0})), 0.5);
  expectMiss(edgeEdge(left, right, still({2, 0, 0}), still({2, 0, 0})));
  // Collinear all the time, one slides into the other.
  expectHitAt(edgeEdge({{-4, 0, 0}, {0, 0, 0}}, {{-3, 0, 0}, {1, 0, 0}}, kA, kB), 0.75);
}

TEST(LinearTruth, AsksVerticesAndEdgesToo) {
  const Path falling{{1, 1, 0}, {1, -3, 0}};
  expectHitAt({LinearKind::VertexEdge, {falling, kA, kB}}, 0.25);
  expectMiss({LinearKind::VertexEdge, {falling, kC, kB}} /* at x = 1 the edge is at y = 3 */);
  expectHitAt({LinearKind::VertexVertex, {falling, still({1, 0, 0})}}, 0.25);
  expectMiss({LinearKind::VertexVertex, {falling, still({1, 0, 0x1p-80})}});
  expectHitAt({LinearKind::VertexVertex, {falling, falling}}, 0.0);
}

TEST(LinearTruth, FindsIrrationalTimes) {
  // At (1, 1) a face whose corner goes to (0, 4 - 2t, -t) lies at height -t / (4 - 2t); the vertex
  // there at 1 - 2t. They meet where 4 t^2 - 9 t + 4 = 0.
  const LinearQuery query = vertexFace({{1, 1, 1}, {1, 1, -1}}, kA, kB, {{0, 4, 0}, {0, 2, -1}});
  const LinearTruth truth = linearTruthByRationals(query);
  ASSERT_TRUE(truth.hits);
  const long double t = (9 - std::sqrt(17.0L)) / 8;
  EXPECT_NEAR(truth.low, static_cast<double>(t), 2e-16);
  EXPECT_LE(truth.high - truth.low, 2e-16);
}

TEST(LinearTruth, FilterAndRationalsAgreeOnEveryFamily) {
  constexpr std::uint64_t kSeed = 77, kEach = 400;
  for (std::size_t f = 0; f < test::linearFamilies().size(); ++f) {
    int told = 0;
    for (std::uint64_t i = 0; i < kEach; ++i) {
      const LinearQuery query = test::drawLinear(f, kSeed, i);
      const auto quick = linearTruthByBalls(query);
      if (!quick) continue;
      ++told;
      const LinearTruth exact = linearTruthByRationals(query);
      ASSERT_EQ(quick->hits, exact.hits) << test::inHex(query);
      EXPECT_LE(quick->low, exact.high) << test::inHex(query);
      EXPECT_GE(quick->high, exact.low) << test::inHex(query);
    }
    EXPECT_GT(told, 100) << test::linearFamilies()[f].name;
  }
}

// The same question after renaming the features' parts, and with time run backwards.
TEST(LinearTruth, DoesNotDependOnTheOrderOfThePoints) {
  for (std::size_t f = 0; f < test::linearFamilies().size(); ++f) {
    for (std::uint64_t i = 0; i < 200; ++i) {
      const LinearQuery query = test::drawLinear(f, 78, i);
      LinearQuery other = query;
      if (query.kind == LinearKind::VertexFace) std::swap(other.points[1], other.points[3]);
      if (query.kind == LinearKind::EdgeEdge) {
        std::swap(other.points[0], other.points[3]);
        std::swap(other.points[1], other.points[2]);
      }
      LinearQuery backwards = query;
      for (Path& p : backwards.points) std::swap(p.from, p.to);
      const LinearTruth truth = linearTruthByRationals(query);
      EXPECT_EQ(truth.hits, linearTruthByRationals(backwards).hits) << test::inHex(query);
      const LinearTruth same = linearTruthByRationals(other);
      ASSERT_EQ(truth.hits, same.hits) << test::inHex(query);
      EXPECT_LE(std::max(truth.low, same.low), std::min(truth.high, same.high));
    }
  }
}

// Controls: what a wrong oracle would say does not hold on these families.
TEST(LinearTruth, SaysNeitherAlwaysNorNever) {
  for (std::size_t f = 0; f < test::linearFamilies().size(); ++f) {
    int hits = 0;
    for (std::uint64_t i = 0; i < 300; ++i) hits += linearTruth(test::drawLinear(f, 79, i)).hits;
    EXPECT_GT(hits, 15) << test::linearFamilies()[f].name;
    EXPECT_LT(hits, 285) << test::linearFamilies()[f].name;
  }
}

}  // namespace
}  // namespace foretouch::oracle
