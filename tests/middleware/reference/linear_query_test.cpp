// Degenerate families by hand: each with its known answer, its known time and the stage that is
// expected to decide.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/middleware/reference/leaf_samples.h"

namespace foretouch::test {
namespace {

/// A large triangle at rest in the plane z = 0.
const std::array<LinearPoint, 3> kStillFloor = {still(0, 0, 0), still(4, 0, 0), still(0, 4, 0)};
const std::array<LinearPoint, 2> kBar = {still(-1, 0, 0), still(1, 0, 0)};  // along x

void expectHit(const LeafAnswer& answer, double toi, LeafStage stage) {
  ASSERT_TRUE(answer.hits);
  EXPECT_LE(answer.toiLow, toi);
  EXPECT_GE(answer.toiHigh, toi);
  EXPECT_LE(answer.toiHigh - answer.toiLow, kLeafTimeAccuracy);
  EXPECT_EQ(answer.stage, stage) << toString(answer.stage);
}

void expectMiss(const LeafAnswer& answer, LeafStage stage) {
  EXPECT_FALSE(answer.hits);
  EXPECT_EQ(answer.toiLow, 1.0);
  EXPECT_EQ(answer.stage, stage) << toString(answer.stage);
}

TEST(VertexFace, CrossingInTheMiddleNeedsOnlyTheFilter) {
  expectHit(vertexFace(moving({1, 1, 1}, {1, 1, -1}), kStillFloor), 0.5, LeafStage::Filter);
  expectHit(vertexFace(moving({1, 1, 1}, {1, 1, -2}), kStillFloor), 1.0 / 3.0, LeafStage::Filter);
}

TEST(VertexFace, PassingBesideNeedsOnlyTheFilter) {
  expectMiss(vertexFace(moving({3, 3, 1}, {3, 3, -1}), kStillFloor), LeafStage::Filter);
  expectMiss(vertexFace(moving({1, 1, 2}, {1, 1, 1}), kStillFloor), LeafStage::Filter);
}

TEST(VertexFace, TouchingAtTheVeryEndOrStartCounts) {
  expectHit(vertexFace(moving({1, 1, 1}, {1, 1, 0}), kStillFloor), 1.0, LeafStage::Exact);
  expectHit(vertexFace(moving({1, 1, 0}, {1, 1, 1}), kStillFloor), 0.0, LeafStage::Exact);
}

TEST(VertexFace, TheLastBitDecides) {
  const double tiny = 0x1p-60;
  expectMiss(vertexFace(moving({1, 1, 1}, {1, 1, 0x1p-300}), kStillFloor), LeafStage::Filter);
  expectMiss(vertexFace(moving({-tiny, 1, 1}, {-tiny, 1, -1}), kStillFloor), LeafStage::Filter);
  const double beyond = std::nextafter(2.0, 3.0);  // past the slanted edge
  expectMiss(vertexFace(moving({beyond, 2, 1}, {beyond, 2, -1}), kStillFloor), LeafStage::Exact);
  expectHit(vertexFace(moving({2, 2, 1}, {2, 2, -1}), kStillFloor), 0.5, LeafStage::Exact);
  expectHit(vertexFace(moving({tiny, 1, 1}, {tiny, 1, -1}), kStillFloor), 0.5, LeafStage::Exact);
  expectHit(vertexFace(moving({0, 1, 1}, {0, 1, -1}), kStillFloor), 0.5, LeafStage::Exact);
}

TEST(VertexFace, MeetingAnEdgeOrAVertexAtATimeThatIsNoDoubleCounts) {
  expectHit(vertexFace(moving({1, 0, 1}, {1, 0, -2}), kStillFloor), 1.0 / 3.0, LeafStage::Exact);
  expectHit(vertexFace(moving({4, 0, 3}, {4, 0, -4}), kStillFloor), 3.0 / 7.0, LeafStage::Exact);
  expectHit(vertexFace(moving({-1, 1, 1}, {2, 1, -2}), kStillFloor), 1.0 / 3.0, LeafStage::Exact);
}

TEST(VertexFace, SlidingInThePlaneIsMetAtTheEdge) {
  expectHit(vertexFace(moving({-1, 1, 0}, {3, 1, 0}), kStillFloor), 0.25, LeafStage::Exact);
  expectHit(vertexFace(moving({-1, 1, 0}, {2, 1, 0}), kStillFloor), 1.0 / 3.0, LeafStage::Exact);
  expectHit(vertexFace(moving({-1, 0, 0}, {3, 0, 0}), kStillFloor), 0.25,
            LeafStage::Exact);  // on a line
  expectMiss(vertexFace(moving({-1, 5, 0}, {5, 5, 0}), kStillFloor), LeafStage::Filter);
  expectMiss(vertexFace(moving({-1, 0, 0}, {0, -1, 0}), kStillFloor), LeafStage::Filter);
}

TEST(VertexFace, SlidingInATiltedMovingPlaneIsMetAtTheEdge) {
  std::array<LinearPoint, 3> face;  // the plane z = x + y, lifted by t
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& p = kStillFloor[i].from;
    face[i] = moving({p.x(), p.y(), p.x() + p.y()}, {p.x(), p.y(), p.x() + p.y() + 1});
  }
  expectHit(vertexFace(moving({-1, 1, 0}, {3, 1, 5}), face), 0.25, LeafStage::Exact);
  expectMiss(vertexFace(moving({-1, 5, 4}, {5, 5, 11}), face), LeafStage::Filter);
}

TEST(VertexFace, FacesWithoutAreaAreSegmentsAndPoints) {
  const std::array<LinearPoint, 3> segment = {still(0, 0, 0), still(2, 0, 0), still(1, 0, 0)};
  expectHit(vertexFace(moving({1, 0, 1}, {1, 0, -1}), segment), 0.5, LeafStage::Exact);
  expectHit(vertexFace(moving({2, 0, 1}, {2, 0, -1}), segment), 0.5, LeafStage::Exact);
  expectMiss(vertexFace(moving({1, 1, 1}, {1, 1, -1}), segment), LeafStage::Filter);
  const std::array<LinearPoint, 3> point = {still(1, 1, 1), still(1, 1, 1), still(1, 1, 1)};
  expectHit(vertexFace(moving({0, 0, 0}, {3, 3, 3}), point), 1.0 / 3.0, LeafStage::Exact);
  expectMiss(vertexFace(moving({0, 0, 0}, {3, 3, 4}), point), LeafStage::Filter);
}

TEST(VertexFace, AFaceThatCollapsesOntoTheVertexIsMetThen) {
  // At t = 1/2 the face shrinks to the vertex's place and opens again, never in its plane else.
  const std::array<LinearPoint, 3> face = {moving({1, 0, 1}, {-1, 0, -1}),
                                           moving({0, 1, 1}, {0, -1, -1}),
                                           moving({-1, -1, 1}, {1, 1, -1})};
  expectHit(vertexFace(still(0, 0, 0), face), 0.5, LeafStage::Exact);
}

TEST(VertexFace, EverythingAtRestIsAStaticTest) {
  expectHit(vertexFace(still(1, 1, 0), kStillFloor), 0.0, LeafStage::Exact);
  expectHit(vertexFace(still(0, 0, 0), kStillFloor), 0.0, LeafStage::Exact);
  expectMiss(vertexFace(still(3, 3, 0), kStillFloor), LeafStage::Filter);
  expectMiss(vertexFace(still(1, 1, 1e-100), kStillFloor), LeafStage::Filter);
}

TEST(EdgeEdge, CrossingInTheMiddleNeedsOnlyTheFilter) {
  expectHit(edgeEdge(kBar, {moving({0, -1, 1}, {0, -1, -1}), moving({0, 1, 1}, {0, 1, -1})}), 0.5,
            LeafStage::Filter);
  expectMiss(edgeEdge(kBar, {moving({2, -1, 1}, {2, -1, -1}), moving({2, 1, 1}, {2, 1, -1})}),
             LeafStage::Filter);
}

TEST(EdgeEdge, GrazingAtADoubleRootCounts) {
  // The volume is (2t - 1)^2: it never changes sign.
  expectHit(edgeEdge(kBar, {moving({0, -1, -1}, {0, -1, 1}), moving({0, -1, 0}, {0, 1, 0})}), 0.5,
            LeafStage::Exact);
  const double z = -0x1p-50;  // the bar lowered: the double root has gone
  expectMiss(edgeEdge({still(-1, 0, z), still(1, 0, z)},
                      {moving({0, -1, -1}, {0, -1, 1}), moving({0, -1, 0}, {0, 1, 0})}),
             LeafStage::Exact);
}

TEST(EdgeEdge, EndsThatMeetCount) {
  expectHit(edgeEdge(kBar, {moving({1, 0, 1}, {1, 0, -1}), moving({2, 1, 1}, {2, 1, -1})}), 0.5,
            LeafStage::Exact);
  expectHit(edgeEdge(kBar, {moving({1, 0, 1}, {1, 0, -2}), moving({1, 2, 1}, {1, 2, -2})}),
            1.0 / 3.0, LeafStage::Exact);
}

TEST(EdgeEdge, ParallelEdgesMeetWhereTheyOverlap) {
  expectHit(edgeEdge(kBar, {moving({0, 0, 1}, {0, 0, -1}), moving({3, 0, 1}, {3, 0, -1})}), 0.5,
            LeafStage::Exact);
  expectMiss(edgeEdge(kBar, {moving({2, 0, 1}, {2, 0, -1}), moving({3, 0, 1}, {3, 0, -1})}),
             LeafStage::Filter);
}

TEST(EdgeEdge, SlidingOnOneLineIsMetEndToEnd) {
  expectHit(edgeEdge(kBar, {moving({4, 0, 0}, {0, 0, 0}), moving({5, 0, 0}, {1, 0, 0})}), 0.75,
            LeafStage::Exact);
  expectHit(edgeEdge(kBar, {moving({4, 0, 0}, {-5, 0, 0}), moving({5, 0, 0}, {-4, 0, 0})}),
            1.0 / 3.0, LeafStage::Exact);
}

TEST(EdgeEdge, CrossingInAPlaneThatTheyNeverLeaveCounts) {
  expectHit(edgeEdge(kBar, {moving({0, 2, 0}, {0, -1, 0}), moving({0, 3, 0}, {0, 0, 0})}),
            2.0 / 3.0, LeafStage::Exact);
  expectMiss(edgeEdge(kBar, {moving({2, 2, 0}, {2, -1, 0}), moving({2, 3, 0}, {2, 0, 0})}),
             LeafStage::Filter);
}

TEST(EdgeEdge, EdgesWithoutLengthArePoints) {
  const std::array<LinearPoint, 2> point = {moving({0, 0, 1}, {0, 0, -1}),
                                            moving({0, 0, 1}, {0, 0, -1})};
  expectHit(edgeEdge(kBar, point), 0.5, LeafStage::Exact);
  expectHit(edgeEdge(point, kBar), 0.5, LeafStage::Exact);
  expectHit(edgeEdge({still(0, 0, 0), still(0, 0, 0)}, point), 0.5, LeafStage::Exact);
  expectMiss(edgeEdge({still(0, 1, 0), still(0, 1, 0)}, point), LeafStage::Filter);
}

TEST(VertexEdge, MeetsTheEdgeAndItsEndsOnly) {
  expectHit(vertexEdge(moving({0, 0, 1}, {0, 0, -1}), kBar), 0.5, LeafStage::Exact);
  expectHit(vertexEdge(moving({1, 0, 1}, {1, 0, -2}), kBar), 1.0 / 3.0, LeafStage::Exact);
  expectHit(vertexEdge(moving({5, 0, 0}, {0, 0, 0}), kBar), 0.8, LeafStage::Exact);
  expectMiss(vertexEdge(moving({2, 0, 1}, {2, 0, -1}), kBar), LeafStage::Filter);
  expectMiss(vertexEdge(moving({0, 0x1p-60, 1}, {0, 0x1p-60, -1}), kBar), LeafStage::Filter);
  expectMiss(vertexEdge(moving({0, 0x1p-60, 1}, {0, -0x1p-61, -1}), kBar), LeafStage::Exact);
}

TEST(VertexVertex, MeetsOnlyWhereAllCoordinatesDo) {
  expectHit(vertexVertex(moving({1, 2, 3}, {-2, -4, -6}), still(0, 0, 0)), 1.0 / 3.0,
            LeafStage::Exact);
  expectHit(vertexVertex(still(1, 2, 3), still(1, 2, 3)), 0.0, LeafStage::Exact);
  expectMiss(vertexVertex(moving({1, 2, 3}, {-2, -4, -7}), still(0, 0, 0)), LeafStage::Filter);
  expectMiss(vertexVertex(moving({1, 2, 3}, {-2, -4, -6}), still(0, 0, 0x1p-70)), LeafStage::Exact);
}

TEST(LinearQuery, ExtremesOfTheAdmittedRangeAreAnswered) {
  const double big = 1e100, small = 1e-100;
  expectHit(vertexFace(moving({small, small, small}, {small, small, -small}),
                       {still(0, 0, 0), still(big, 0, 0), still(0, big, 0)}),
            0.5, LeafStage::Exact);
  expectMiss(vertexFace(moving({-small, small, big}, {-small, small, -big}),
                        {still(0, 0, 0), still(big, 0, small), still(0, big, -small)}),
             LeafStage::Filter);
  expectMiss(vertexFace(moving({-2 * small, small, big}, {-2 * small, small, -big}),
                        {still(0, 0, 0), still(big, 0, small), still(-big, big, -small)}),
             LeafStage::Exact);
  expectHit(vertexFace(moving({big, big, big}, {-big, -big, -big}),
                       {still(-big, -big, 0), still(big, 0, 0), still(0, big, 0)}),
            0.5, LeafStage::Filter);
}

}  // namespace
}  // namespace foretouch::test
