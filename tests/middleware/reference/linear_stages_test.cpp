// Properties of random linear queries: the stages agree, the order of the arguments does not
// matter, planted contacts are found and what is said to be free is free.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/middleware/reference/leaf_samples.h"
#include "tests/reference/moving_polygon.h"

namespace foretouch::test {
namespace {

using oracle::Precise3;
using oracle::preciseDistance;
using Real = oracle::Precise;
using internal::Decision;
using internal::StageAnswer;

internal::MovingPolygon polygonFor(int kind, const FourPoints& p, std::array<LinearPoint, 3>& face,
                                   std::array<std::array<LinearPoint, 2>, 2>& edges) {
  face = {p[1], p[2], p[3]};
  edges = {std::array<LinearPoint, 2>{p[0], p[1]}, std::array<LinearPoint, 2>{p[2], p[3]}};
  switch (kind) {
    case 0: return internal::polygonOf(p[0], face);
    case 1: return internal::polygonOf(edges[0], edges[1]);
    case 2: return internal::polygonOf(p[0], edges[1]);
    default: return internal::polygonOf(p[0], p[1]);
  }
}

FourPoints drawPoints(Random& random) {
  switch (random.below(3)) {
    case 0: return onLattice(random, 2);
    case 1: return nearLattice(random);
    default: return anywhere(random);
  }
}

TEST(LinearStages, NeverContradictEachOther) {
  constexpr int kCases = 30000;
  int told = 0, hits = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const FourPoints points = drawPoints(random);
    std::array<LinearPoint, 3> face;
    std::array<std::array<LinearPoint, 2>, 2> edges;
    const auto polygon = polygonFor(random.below(4), points, face, edges);
    const StageAnswer filter = internal::filterStage(polygon),
                      exact = internal::exactStage(polygon);
    ASSERT_NE(exact.decision, Decision::CannotTell);
    hits += exact.decision == Decision::Yes;
    if (filter.decision == Decision::CannotTell) continue;
    ++told;
    ASSERT_EQ(filter.decision, exact.decision);
    if (exact.decision != Decision::Yes) continue;
    EXPECT_LE(filter.toiLow, exact.toiHigh);
    EXPECT_GE(filter.toiHigh, exact.toiLow);
  }
  EXPECT_GT(told, kCases / 2);
  EXPECT_LT(told, kCases);
  EXPECT_GT(hits, kCases / 20);
}

/// Every query and its rearrangements hit alike, at the same time; backwards in time alike.
template <class Ask>
void expectSameAnswer(const FourPoints& p, const std::vector<std::array<int, 4>>& orders, Ask ask,
                      int& hits) {
  const LeafAnswer first = ask(p);
  hits += first.hits;
  for (const auto& order : orders) {
    const LeafAnswer other = ask({p[order[0]], p[order[1]], p[order[2]], p[order[3]]});
    ASSERT_EQ(other.hits, first.hits);
    EXPECT_LE(other.toiLow, first.toiHigh);
    EXPECT_GE(other.toiHigh, first.toiLow);
  }
  const FourPoints back = {reversed(p[0]), reversed(p[1]), reversed(p[2]), reversed(p[3])};
  EXPECT_EQ(ask(back).hits, first.hits);
}

TEST(LinearQuery, DoesNotDependOnTheOrderOfItsArguments) {
  constexpr int kCases = 4000;
  const std::vector<std::array<int, 4>> faceOrders = {
      {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 3, 2}, {0, 3, 2, 1}, {0, 2, 1, 3}};
  const std::vector<std::array<int, 4>> edgeOrders = {
      {1, 0, 2, 3}, {0, 1, 3, 2}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 0, 1}};
  int faceHits = 0, edgeHits = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const FourPoints points = drawPoints(random);
    expectSameAnswer(points, faceOrders, askVertexFace, faceHits);
    expectSameAnswer(points, edgeOrders, askEdgeEdge, edgeHits);
  }
  EXPECT_GT(faceHits, kCases / 20);
  EXPECT_GT(edgeHits, kCases / 20);
  EXPECT_LT(faceHits + edgeHits, kCases);
}

/// A point of the triangle or edge pair with dyadic weights, so that the contact is exact.
struct Planted {
  FourPoints points;
  double toi;
};

/// At `toi` the vertex is exactly on the face; all motions have dyadic steps.
Planted plantVertexFace(Random& random) {
  Planted planted;
  planted.toi = random.below(17) / 16.0;
  const auto lattice = [&] {
    return Eigen::Vector3d(random.below(65) - 32, random.below(65) - 32, random.below(65) - 32);
  };
  std::array<Eigen::Vector3d, 4> at;
  for (int i = 1; i < 4; ++i) at[i] = lattice();
  const int a = random.below(9), b = random.below(9 - a);
  at[0] = (a * at[1] + b * at[2] + (8 - a - b) * at[3]) / 8.0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d velocity = lattice();
    planted.points[i] = {at[i] - planted.toi * velocity, at[i] + (1.0 - planted.toi) * velocity};
  }
  return planted;
}

TEST(VertexFace, FindsPlantedContactsAndIsFreeBefore) {
  constexpr int kCases = 4000;
  int first = 0;
  for (int seed = 0; seed < kCases; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Planted planted = plantVertexFace(random);
    const LeafAnswer answer = askVertexFace(planted.points);
    ASSERT_TRUE(answer.hits);
    ASSERT_LE(answer.toiLow, planted.toi);
    ASSERT_LE(answer.toiHigh - answer.toiLow, kLeafTimeAccuracy);
    first += answer.toiHigh >= planted.toi;
    if (seed % 20 != 0) continue;
    for (int k = 0; k < 10; ++k) {
      const Real t = Real(answer.toiLow) * k / 10;
      if (answer.toiLow == 0.0) break;
      std::array<Precise3, 4> at;
      for (int i = 0; i < 4; ++i) {
        const Precise3 from(planted.points[i].from), to(planted.points[i].to);
        at[i] = from + t * (to - from);
      }
      ASSERT_GT(preciseDistance(at[0], at[0], {at[1], at[2], at[3]}), 0);
    }
  }
  EXPECT_GT(first, kCases / 2);  // the planted contact is often the first: toi = 0 would not pass
}

/// One unit in the last place below a face that is met at rest: the exact miss beside an exact hit.
TEST(VertexFace, TellsAPlantedContactFromANearMiss) {
  int checked = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double x = random.uniform(0.1, 1.0), y = random.uniform(0.1, 1.0);
    const std::array<LinearPoint, 3> face = {still(0, 0, 0), still(x, x, 1), still(y, y, -1)};
    // In the face's plane x = y, moving along it, one last bit off it or not.
    const double p = 0.25 * std::min(x, y), off = std::nextafter(p, 1.0);
    EXPECT_TRUE(vertexFace(moving({p, p, 3}, {p, p, -3}), face).hits);
    EXPECT_FALSE(vertexFace(moving({p, off, 3}, {p, off, -3}), face).hits);
    ++checked;
  }
  EXPECT_EQ(checked, 2000);
}

}  // namespace
}  // namespace foretouch::test
