// Faces of many corners: count, cover and area of what cutPolygon() makes of them.
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/import/polygon.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<CornerTriple> cut(const std::vector<Vector3d>& corners) {
  std::vector<CornerTriple> triangles;
  cutPolygon(corners, triangles);
  return triangles;
}

double areaOf(const std::vector<Vector3d>& corners, const CornerTriple& t) {
  return 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).norm();
}

double areaOf(const std::vector<Vector3d>& corners) {
  double area = 0.0;
  for (const CornerTriple& t : cut(corners)) area += areaOf(corners, t);
  return area;
}

/// A simple polygon, mostly concave: corners at growing angles and any distance from the origin.
std::vector<Vector2d> starShaped(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> distance(0.1, 1.0), shift(0.1, 0.9);
  std::vector<Vector2d> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * (static_cast<double>(i) + shift(random)) / double(count);
    corners.push_back(distance(random) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

std::vector<Vector3d> lifted(const std::vector<Vector2d>& corners, const Eigen::Isometry3d& frame) {
  std::vector<Vector3d> result;
  for (const Vector2d& c : corners) result.push_back(frame * Vector3d(c.x(), c.y(), 0.0));
  return result;
}

Eigen::Isometry3d anyFrame(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
  frame.linear() = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  frame.translation() = 5.0 * Vector3d(normal(random), normal(random), normal(random));
  return frame;
}

double shoelace(const std::vector<Vector2d>& p) {
  double twice = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2d &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

/// How often the closed polygon winds around `x`, by the angles its edges are seen at.
int windingAround(const std::vector<Vector2d>& p, const Vector2d& x) {
  double angle = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2d a = p[i] - x, b = p[(i + 1) % p.size()] - x;
    angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return static_cast<int>(std::lround(angle / (2 * M_PI)));
}

bool covers(const std::vector<Vector2d>& p, const CornerTriple& t, const Vector2d& x) {
  return windingAround({p[t[0]], p[t[1]], p[t[2]]}, x) != 0;
}

TEST(CutPolygon, CutsAConvexPolygonIntoAFanFromItsFirstCorner) {
  const std::vector<Vector3d> pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 2, 0}, {1, 3, 0}, {-1, 2, 0}};
  EXPECT_EQ(cut(pentagon), (std::vector<CornerTriple>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(CutPolygon, LeavesTheNotchOfAConcaveQuadOpen) {
  const std::vector<Vector3d> arrow = {{0, 0, 1}, {2, 2, 1}, {0, 1, 1}, {-2, 2, 1}};
  EXPECT_DOUBLE_EQ(areaOf(arrow), 2.0);
}

TEST(CutPolygon, CoversASimplePolygonExactlyInAnyPlane) {
  int concave = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    auto flat = starShaped(random, 4 + seed % 20);
    if (seed % 2 == 0) std::reverse(flat.begin(), flat.end());
    const auto corners = lifted(flat, anyFrame(random));
    ASSERT_EQ(cut(corners).size(), corners.size() - 2);
    // Equal to the polygon's area and, as the signed sum always is, so without overlap.
    ASSERT_NEAR(areaOf(corners), shoelace(flat), 1e-12 * 100) << seed;
    std::vector<CornerTriple> fan;
    double fanArea = 0.0;
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
      fanArea += areaOf(corners, {0, i, i + 1});
    concave += fanArea > shoelace(flat) + 1e-6;
  }
  EXPECT_GT(concave, 1000);  // a fan would not have done
}

TEST(CutPolygon, CoversWhateverACrossingPolygonWindsAround) {
  int inside = 0, crossing = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vector2d> flat;
    for (std::size_t i = 0; i < 4 + seed % 9; ++i) flat.emplace_back(unit(random), unit(random));
    const auto corners = lifted(flat, Eigen::Isometry3d::Identity());
    const auto triangles = cut(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2) << seed;
    for (int sample = 0; sample < 20; ++sample) {
      const Vector2d x(unit(random), unit(random));
      if (windingAround(flat, x) == 0) continue;
      ++inside;
      const bool covered = std::any_of(triangles.begin(), triangles.end(),
                                       [&](const auto& t) { return covers(flat, t, x); });
      ASSERT_TRUE(covered) << "seed " << seed << " at " << x.transpose();
    }
    crossing += areaOf(corners) > shoelace(flat) + 1e-9;
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(crossing, 1000);
}

TEST(CutPolygon, FollowsTheBridgeToAHole) {
  // A square of side 4 with a square hole of side 2, joined by a bridge that is walked twice.
  const std::vector<Vector3d> ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                      {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(cut(ring).size(), 8U);
  EXPECT_DOUBLE_EQ(areaOf(ring), 12.0);
}

TEST(CutPolygon, GivesAllTrianglesOfAPolygonOutOfPlane) {
  // The hexagon that the model reader's own step leaves two triangles of.
  const std::vector<Vector3d> hexagon = {{0.2, 0.2, 7}, {1, 0, 3},     {0, 1, 5},
                                         {0, 0, 0},     {-1, 0.5, -2}, {1, 1, -4}};
  const auto triangles = cut(hexagon);
  EXPECT_EQ(triangles.size(), 4U);
  std::vector<int> used(hexagon.size(), 0);
  for (const CornerTriple& t : triangles) {
    for (const auto corner : t) ++used[corner];
  }
  for (const int count : used) EXPECT_GT(count, 0);
}

TEST(CutPolygon, KeepsItsCountForPolygonsWithoutAPlane) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Vector3d o = Vector3d::Zero();
  const std::vector<std::vector<Vector3d>> polygons = {
      {o, o, o, o, o},
      {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}},
      {{0, 0, 0}, {1, 0, 0}, {kNan, 1, 0}, {0, 1, 0}},
      {{0, 0, 0}, {1, 0, 0}, {kInfinity, 1, 0}, {0, 1, 0}, {0, 0.5, 0}},
      {{1e300, 0, 0}, {0, 1e300, 0}, {-1e300, 0, 0}, {0, -1e300, 0}},
      {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}};  // a bow-tie of equal halves
  for (const auto& polygon : polygons) EXPECT_EQ(cut(polygon).size(), polygon.size() - 2);
}

TEST(CutPolygon, AppendsToWhatIsThere) {
  std::vector<CornerTriple> triangles = {{7, 8, 9}};
  cutPolygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles);
  EXPECT_EQ(triangles, (std::vector<CornerTriple>{{7, 8, 9}, {0, 1, 2}}));
}

}  // namespace
}  // namespace foretouch::internal
