// What has an inside, and what is in it.
#include "middleware/exact/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "judge/precise.h"
#include "judge/vector.h"
#include "middleware/triggers/triggers.h"
#include "middleware/triggers/volume_parts.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::ClosedMesh;
using internal::PointPlace;

/// A ball of triangles: rings of corners about z.
RawScene globe(double radius, int rings, int segments, const Vector3d& center = Vector3d::Zero()) {
  RawScene raw;
  raw.objectNames = {"globe"};
  const auto corner = [&](int ring, int k) -> Vector3d {
    const double polar = 3.141592653589793 * ring / rings;
    const double angle = 6.283185307179586 * (k % segments) / segments;
    if (ring == 0 || ring == rings) return center + Vector3d(0, 0, ring == 0 ? radius : -radius);
    return center + radius * Vector3d(std::sin(polar) * std::cos(angle),
                                      std::sin(polar) * std::sin(angle), std::cos(polar));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int k = 0; k < segments; ++k) {
      const Vector3d a = corner(ring, k), b = corner(ring, k + 1);
      const Vector3d c = corner(ring + 1, k), d = corner(ring + 1, k + 1);
      if (ring > 0) raw.triangles.push_back({{a, c, b}});
      if (ring + 1 < rings) raw.triangles.push_back({{b, c, d}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

ClosedMesh closed(RawScene raw) {
  return ClosedMesh::build(Scene::build(std::move(raw)).value()).value();
}

TEST(ClosedMesh, KnowsTheInsideOfAGlobe) {
  const int rings = 12, segments = 16;
  const ClosedMesh mesh = closed(globe(1.0, rings, segments));
  // Between the ball inside the triangles and the one around their corners, nothing is said here.
  const double within = std::cos(3.2 / segments) * std::cos(1.7 / rings);
  ClosedMesh::Memory memory;
  int inside = 0, outside = 0;
  for (int i = 0; i < 20000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    Vector3d p = random.inBox(1.2);
    // Below corners, edges and the poles.
    if (random.chance(0.3)) p.x() = 0.0;
    if (random.chance(0.3)) p.y() = 0.0;
    const double r = p.norm();
    if (r > within && r < 1.0) continue;
    const PointPlace place = mesh.placeOf(p, 1e-12, memory);
    ASSERT_EQ(place, r < 1.0 ? PointPlace::Inside : PointPlace::Outside) << p.transpose();
    ++(r < 1.0 ? inside : outside);
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(outside, 3000);
}

TEST(ClosedMesh, RefusesAHoleAndNamesItsEdge) {
  RawScene raw = globe(1.0, 6, 8);
  raw.triangles.erase(raw.triangles.begin() + 20);
  raw.objectOf.pop_back();
  const auto refused = ClosedMesh::build(Scene::build(raw).value());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::Mismatch);
  EXPECT_NE(refused.error().message.find("'globe'"), std::string::npos) << refused.error().message;
  EXPECT_NE(refused.error().message.find("belongs to one triangle"), std::string::npos);
  EXPECT_GE(refused.error().index, 0);
}

TEST(ClosedMesh, RefusesAFinOnAClosedSurface) {
  RawScene raw = globe(1.0, 6, 8);
  const auto& v = raw.triangles[20].vertices;
  raw.triangles.push_back({{v[0], v[1], 3.0 * v[0]}});
  raw.objectOf.push_back(0);
  EXPECT_FALSE(ClosedMesh::build(Scene::build(raw).value()).ok());
}

TEST(ClosedMesh, DoesNotCareHowTrianglesAreTurnedOrOrdered) {
  RawScene raw = globe(1.0, 6, 8);
  test::Random random(3);
  for (Triangle& triangle : raw.triangles) {
    if (random.chance(0.5)) std::swap(triangle.vertices[0], triangle.vertices[1]);
  }
  std::reverse(raw.triangles.begin(), raw.triangles.end());
  ClosedMesh::Memory memory;
  const ClosedMesh mesh = closed(raw);
  EXPECT_EQ(mesh.placeOf(Vector3d::Zero(), 0.0, memory), PointPlace::Inside);
  EXPECT_EQ(mesh.placeOf(Vector3d(0, 0, -2), 0.0, memory), PointPlace::Outside);
}

/// Two globes in one scene; of one object, or each of its own.
RawScene twoGlobes(const Vector3d& center, double radius, bool isOneObject) {
  RawScene raw = globe(1.0, 8, 12);
  const RawScene other = globe(radius, 8, 12, center);
  raw.triangles.insert(raw.triangles.end(), other.triangles.begin(), other.triangles.end());
  raw.objectNames.emplace_back("other");
  raw.objectOf.resize(raw.triangles.size(), isOneObject ? 0 : 1);
  return raw;
}

// Of one object, what two shells share is outside: a hollow ball. Two objects are one volume.
TEST(ClosedMesh, ShellsOfOneObjectAreHollowAndObjectsAreOneVolume) {
  ClosedMesh::Memory memory;
  const ClosedMesh hollow = closed(twoGlobes(Vector3d::Zero(), 0.5, true));
  EXPECT_EQ(hollow.placeOf(Vector3d(0.1, 0, 0), 0.0, memory), PointPlace::Outside);
  EXPECT_EQ(hollow.placeOf(Vector3d(0.7, 0, 0), 0.0, memory), PointPlace::Inside);
  const ClosedMesh both = closed(twoGlobes(Vector3d(0.8, 0, 0), 1.0, false));
  EXPECT_EQ(both.placeOf(Vector3d(0.4, 0, 0), 0.0, memory), PointPlace::Inside);
  EXPECT_EQ(both.placeOf(Vector3d(-0.5, 0, 0), 0.0, memory), PointPlace::Inside);
  EXPECT_EQ(both.placeOf(Vector3d(1.5, 0, 0), 0.0, memory), PointPlace::Inside);
}

TEST(ClosedMesh, SaysWhereItCannotTell) {
  ClosedMesh::Memory memory;
  const auto box = TriggerVolume::box(Vector3d(1, 2, 3)).value();
  const ClosedMesh& mesh = *box.parts().mesh;
  EXPECT_EQ(mesh.placeOf(Vector3d(0.9, 0, 0), 0.05, memory), PointPlace::Inside);
  EXPECT_EQ(mesh.placeOf(Vector3d(0.9, 0, 0), 0.15, memory), PointPlace::AtSurface);
  EXPECT_EQ(mesh.placeOf(Vector3d(1, 2, 3), 0.0, memory), PointPlace::AtSurface);
}

// Rounding tilts a plane between a point and an edge that is nanometres away: that is no reason not
// to know.
TEST(ClosedMesh, KnowsNanometresFromAnEdgeOnWhichSideItIs) {
  using Number = oracle::Exact;
  using Point = oracle::Vec3<Number>;
  ClosedMesh::Memory memory;
  int inside = 0, outside = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    std::array<Vector3d, 4> v;
    for (Vector3d& corner : v) corner = random.inBox(0.3);
    RawScene raw;
    raw.objectNames = {"tetrahedron"};
    raw.triangles = {
        {{v[0], v[1], v[2]}}, {{v[0], v[1], v[3]}}, {{v[0], v[2], v[3]}}, {{v[1], v[2], v[3]}}};
    raw.objectOf.assign(4, 0);
    const ClosedMesh mesh = closed(raw);
    const double share = random.uniform(0.1, 0.9);
    const double off = random.magnitude(1e-10, 1e-8);
    const Vector3d p = (1.0 - share) * v[0] + share * v[1] + off * random.direction();
    // Inside: it may take the place of any corner, and the volume keeps its sign.
    const auto volume = [](const std::array<Vector3d, 4>& at) {
      const Point a(at[0]);
      return dot(Point(at[1]) - a, cross(Point(at[2]) - a, Point(at[3]) - a));
    };
    bool isInside = true;
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<Vector3d, 4> with = v;
      with[k] = p;
      isInside = isInside && volume(v) * volume(with) > Number(0);
    }
    ASSERT_EQ(mesh.placeOf(p, 0.0, memory), isInside ? PointPlace::Inside : PointPlace::Outside);
    ASSERT_EQ(mesh.placeOf(p, 1.001 * off, memory), PointPlace::AtSurface);
    ++(isInside ? inside : outside);
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 500);
}

TEST(TriggerVolume, RefusesWhatHasNoInside) {
  EXPECT_FALSE(TriggerVolume::box(Vector3d(1, 0, 1)).ok());
  EXPECT_FALSE(TriggerVolume::box(Vector3d(1, -1, 1)).ok());
  EXPECT_FALSE(TriggerVolume::box(Vector3d(1, std::nan(""), 1)).ok());
  EXPECT_FALSE(TriggerVolume::sphere(0.0).ok());
  EXPECT_FALSE(TriggerVolume::sphere(-1.0).ok());
  EXPECT_FALSE(TriggerVolume::lss({}).ok());
  EXPECT_TRUE(TriggerVolume::lss({{{0, 0, 0}, {0, 1, 0}, 0.1}}).ok());
}

}  // namespace
}  // namespace foretouch
