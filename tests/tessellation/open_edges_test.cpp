// Which edges of triangles are a border.
#include "tessellation/open_edges.h"

#include <cmath>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::OpenEdge;
using internal::openEdges;

std::vector<Triangle> tetrahedron(const Vector3d& shift) {
  const Vector3d o = shift, x = shift + Vector3d::UnitX(), y = shift + Vector3d::UnitY(),
                 z = shift + Vector3d::UnitZ();
  return {{{o, x, y}}, {{o, z, x}}, {{o, y, z}}, {{x, z, y}}};
}

TEST(OpenEdges, AreTheFirstOfEachObjectThatIsNotClosed) {
  std::vector<Triangle> triangles = tetrahedron(Vector3d::Zero());
  for (const Triangle& triangle : tetrahedron(Vector3d(5, 0, 0))) triangles.push_back(triangle);
  const std::vector<std::int32_t> objectOf{0, 0, 0, 0, 1, 1, 1, 1};
  EXPECT_TRUE(openEdges(triangles.data(), {0, 1, 2, 3, 4, 5, 6, 7}, objectOf.data()).empty());
  const auto open = openEdges(triangles.data(), {0, 1, 2, 3, 4, 5, 6}, objectOf.data());
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].object, 1);
  EXPECT_EQ(open[0].count, 1u);
  const auto rooms =
      internal::objectRooms(triangles.data(), {0, 1, 2, 3, 4, 5, 6}, objectOf.data(), 3);
  EXPECT_TRUE(rooms[0].isClosed);
  EXPECT_FALSE(rooms[1].isClosed);
  EXPECT_TRUE(rooms[2].isClosed) << "of nothing";
  EXPECT_EQ(rooms[1].box.max, Vector3d(6, 1, 1));
}

// Three triangles at an edge leave no inside; how an author turned them, and which zero he wrote,
// does not matter. Zeros that are told have no sign.
TEST(OpenEdges, HaveAnOddNumberOfTrianglesWhateverTheirSigns) {
  std::vector<Triangle> triangles = tetrahedron(Vector3d::Zero());
  std::swap(triangles[1].vertices[0], triangles[1].vertices[1]);
  for (Vector3d& v : triangles[2].vertices)
    v = v.unaryExpr([](double x) { return x == 0.0 ? -0.0 : x; });
  EXPECT_TRUE(openEdges(triangles.data(), {0, 1, 2, 3}, nullptr).empty());
  const Vector3d p(-0.0, -0.0, -0.0), q(0, 0, 1);
  const std::vector<Triangle> fan{{{p, q, Vector3d(1, 0, 0)}},
                                  {{q, p, Vector3d(0, 1, 0)}},
                                  {{p, q, Vector3d(-1, 0, 0)}},
                                  {{p, p, q}}};
  const auto open = openEdges(fan.data(), {0, 1, 2}, nullptr);
  ASSERT_EQ(open.size(), 1u);
  for (const auto& end : {open[0].from, open[0].to}) {
    for (const double x : end) EXPECT_FALSE(x == 0.0 && std::signbit(x));
  }
  EXPECT_TRUE(openEdges(fan.data(), {3}, nullptr).empty()) << "both ways along one edge";
}

}  // namespace
}  // namespace foretouch
