// LSS that cover triangles: containment in fifty digits, splits that pay, volumes from below.
#include "lss/lss_cover.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/hull_volume.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using Real = oracle::Precise;

constexpr double kPi = 3.14159265358979323846;

bool contains(const Lss& lss, const Vector3d& point) {
  const Precise3 p(point);
  return oracle::preciseDistance(Precise3(lss.a), Precise3(lss.b), {p, p, p}) <= Real(lss.radius);
}

bool contains(const Lss& lss, const Triangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [&](const Vector3d& v) { return contains(lss, v); });
}

int outsideOf(const std::vector<Lss>& lss, const std::vector<Triangle>& triangles) {
  return static_cast<int>(
      std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& triangle) {
        return std::none_of(lss.begin(), lss.end(),
                            [&](const Lss& l) { return contains(l, triangle); });
      }));
}

/// Two triangles for each cell of a grid bent around an ellipsoid.
std::vector<Triangle> ellipsoid(int rings, int sectors, const Vector3d& radii,
                                const Vector3d& center) {
  const auto at = [&](int ring, int sector) -> Vector3d {
    const double polar = kPi * ring / rings, azimuth = 2 * kPi * sector / sectors;
    return center +
           radii.cwiseProduct(Vector3d(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                       std::sin(polar) * std::sin(azimuth)));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  return triangles;
}

double totalVolume(const std::vector<Lss>& lss) {
  double sum = 0.0;
  for (const Lss& l : lss) sum += volume(l);
  return sum;
}

std::vector<Triangle> randomSoup(test::Random& random) {
  const Vector3d center = random.chance(0.2) ? random.inBox(1e5) : random.inBox(1.0);
  const double size = random.magnitude(1e-3, 10.0);
  std::vector<Triangle> soup;
  for (int i = 1 + random.below(80); i-- > 0;) {
    soup.push_back({test::randomPair(random, size, center + random.inBox(3 * size)).v});
  }
  return soup;
}

TEST(CoverTriangles, EachTriangleIsWhollyInOneLssRoundingIncluded) {
  int split = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const auto triangles = randomSoup(random);
    const int most = 1 + random.below(6);
    const auto lss = coverTriangles(triangles, most);
    ASSERT_GE(lss.size(), 1u);
    ASSERT_LE(lss.size(), static_cast<std::size_t>(most));
    ASSERT_EQ(outsideOf(lss, triangles), 0);
    split += lss.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(split, 40);  // both ways are exercised
  EXPECT_LT(split, 190);
}

TEST(CoverTriangles, TheCheckWouldSeeATriangleThatSticksOut) {
  const auto triangles = ellipsoid(8, 8, {1, 1, 1}, {0, 0, 0});
  auto lss = coverTriangles(triangles, 1);
  EXPECT_EQ(outsideOf(lss, triangles), 0);
  lss[0].radius *= 1.0 - 1e-12;
  EXPECT_GT(outsideOf(lss, triangles), 0);
}

TEST(CoverTriangles, DegenerateTrianglesAreCovered) {
  const Vector3d p(1, 2, 3), q(1.5, 2, 3);
  const auto point = coverTriangles(std::vector<Triangle>(9, Triangle{{p, p, p}}), 4);
  ASSERT_EQ(point.size(), 1u);
  EXPECT_EQ(point[0].radius, 0.0);
  EXPECT_EQ(point[0].a, p);

  std::vector<Triangle> line;
  for (int i = 0; i < 400; ++i) {
    const double s = i / 400.0;
    line.push_back({{p + s * (q - p), p + s * (q - p), q}});
  }
  const auto onLine = coverTriangles(line, 4);
  EXPECT_EQ(outsideOf(onLine, line), 0);
  EXPECT_LT(totalVolume(onLine), 1e-20);
  EXPECT_TRUE(coverTriangles({}, 4).empty());
}

TEST(CoverTriangles, SplitsWhereItPaysAndOnlyThere) {
  auto knee = ellipsoid(12, 12, {0.05, 0.4, 0.05}, {0, 0.4, 0});
  const auto shin = ellipsoid(12, 12, {0.4, 0.05, 0.05}, {0.4, 0, 0});
  knee.insert(knee.end(), shin.begin(), shin.end());
  const auto one = coverTriangles(knee, 1), two = coverTriangles(knee, 2);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_LT(totalVolume(two), 0.25 * totalVolume(one));
  EXPECT_EQ(outsideOf(two, knee), 0);
  EXPECT_EQ(coverTriangles(ellipsoid(12, 12, {1, 1, 1}, {0, 0, 0}), 4).size(), 1u);
  const std::vector<Triangle> apart = {
      {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}},
      {{Vector3d(9, 9, 0), Vector3d(9, 10, 0), Vector3d(9, 9, 1)}}};
  EXPECT_EQ(coverTriangles(apart, 4).size(), 2u);
}

TEST(CoverTriangles, LargeMeshesAreCoveredFromTheirExtremePoints) {
  const auto triangles = ellipsoid(136, 136, {0.2, 0.9, 0.15}, {0, 0.9, 0});
  ASSERT_GE(triangles.size(), 36992u);
  const auto lss = coverTriangles(triangles, 4);
  std::vector<Triangle> sample;  // fifty digits take their time
  for (std::size_t i = 0; i < triangles.size(); i += 37) sample.push_back(triangles[i]);
  EXPECT_EQ(outsideOf(lss, sample), 0);
  EXPECT_EQ(measureCover(lss, triangles).outside, 0u);
  EXPECT_LT(totalVolume(coverTriangles(triangles, 1)),
            1.02 * volume({{0, 0.2, 0}, {0, 1.6, 0}, 0.2}));
}

TEST(CoverTriangles, SameTrianglesSameLss) {
  const auto triangles = ellipsoid(20, 20, {0.1, 1, 0.3}, {0, 0, 0});
  const auto first = coverTriangles(triangles, 4), again = coverTriangles(triangles, 4);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].a, again[i].a);
    EXPECT_EQ(first[i].b, again[i].b);
    EXPECT_EQ(first[i].radius, again[i].radius);
  }
}

// Places are multiples of 2^-20 m, so a shift by whole metres changes none of their differences:
// how triangles are split depends on these alone. Two rods side by side, which only a cut across
// their own axes takes apart.
TEST(CoverTriangles, CoverTheSameWayWhereverTheyAre) {
  test::Random random(9);
  std::vector<Triangle> rods, shifted;
  for (int i = 0; i < 60; ++i) {
    const Vector3d middle(4.0 * (i % 30) / 30.0, i < 30 ? 0.0 : 1.0, 0.0);
    Triangle triangle;
    for (Vector3d& v : triangle.vertices) {
      for (int axis = 0; axis < 3; ++axis) {
        v[axis] =
            std::ldexp(std::round(std::ldexp(middle[axis] + random.uniform(-0.1, 0.1), 20)), -20);
      }
    }
    rods.push_back(triangle);
    for (Vector3d& v : triangle.vertices) v += Vector3d(64, 64, 0);
    shifted.push_back(triangle);
  }
  const auto here = coverTriangles(rods, 4), there = coverTriangles(shifted, 4);
  ASSERT_GT(here.size(), 1u);
  ASSERT_EQ(there.size(), here.size());
  EXPECT_NEAR(totalVolume(there), totalVolume(here), 1e-6 * totalVolume(here));
}

TEST(MeasureCover, SaysHowFarTheWorstTriangleSticksOut) {
  const Lss ball{{0, 0, 0}, {0, 0, 0}, 1.0}, far{{9, 0, 0}, {9, 0, 0}, 2.0};
  const std::vector<Triangle> triangles = {
      {{Vector3d(0.5, 0, 0), Vector3d(0, 0.5, 0), Vector3d(0, 0, 0.5)}},
      {{Vector3d(0, 0, 0), Vector3d(1.25, 0, 0), Vector3d(0, 1, 0)}},
      {{Vector3d(0, 0, 0), Vector3d(0, -1.5, 0), Vector3d(0, 1, 0)}},
      {{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0.5, 0, 0)}}};  // to its surface
  const CoverMeasure measure = measureCover({ball, far}, triangles);
  EXPECT_EQ(measure.outside, 2u);
  EXPECT_NEAR(measure.worstOutside, 0.5, 1e-15);
  EXPECT_NEAR(measure.lssVolume, 4.0 / 3.0 * kPi, 1e-12);  // the far one contains nothing
  // Of a pyramid half a metre high, on a triangle of 2.5 m by 1.25 m.
  EXPECT_NEAR(measure.hullVolume, 0.5 * 2.5 * 1.25 * 0.5 / 3.0, 1e-12);
  EXPECT_TRUE(std::isinf(measureCover({}, triangles).worstOutside));
  EXPECT_EQ(measureCover({}, triangles).outside, 4u);
  EXPECT_EQ(measureCover({ball}, {}).worstOutside, 0.0);
}

TEST(HullVolume, IsExactForBoxesAndLittleBelowForBalls) {
  std::vector<Vector3d> box, ball;
  for (int i = 0; i < 8; ++i) box.emplace_back(i & 1, (i >> 1 & 1) * 2.0, (i >> 2 & 1) * 3.0);
  box.emplace_back(0.5, 0.5, 0.5);
  box.emplace_back(0.5, 0.0, 1.5);  // on a face
  EXPECT_NEAR(hullVolume(box), 6.0, 1e-12);
  test::Random random(1);
  for (int i = 0; i < 20000; ++i) ball.push_back(random.direction());
  EXPECT_LT(hullVolume(ball), 4.0 / 3.0 * kPi);
  EXPECT_GT(hullVolume(ball), 0.94 * 4.0 / 3.0 * kPi);
}

// A thin tetrahedron far from the origin, along the direction in which it is thin.
TEST(HullVolume, DoesNotDependOnWhereThePointsAre) {
  for (const double far : {-100.0, 0.0, 100.0}) {
    const Vector3d shift(0, far, 0);
    const std::vector<Vector3d> points{Vector3d(-10, 0, 0) + shift, Vector3d(10, 0, 0) + shift,
                                       Vector3d(0, 1, 0) + shift, Vector3d(0, 1, 1) + shift};
    EXPECT_NEAR(hullVolume(points), 20.0 / 6.0, 1e-12) << far;
  }
}

TEST(HullVolume, CountsTheOutermostOfManyPoints) {
  test::Random random(6);
  std::vector<Vector3d> ball;
  for (int i = 0; i < 20000; ++i) {
    const double within = i % 5 == 0 ? 1.0 : random.uniform(0.0, 0.9);
    ball.push_back(within * random.direction());
  }
  EXPECT_GT(hullVolume(ball), 0.9 * 4.0 / 3.0 * kPi);
  const std::vector<Vector3d> extremes = extremePoints(ball);
  EXPECT_GT(extremes.size(), 200u);
  for (const Vector3d& p : extremes) EXPECT_GT(p.norm(), 0.99);
  for (int axis = 0; axis < 3; ++axis) {
    const auto isLess = [axis](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; };
    const auto [low, high] = std::minmax_element(ball.begin(), ball.end(), isLess);
    for (const Vector3d& end : {*low, *high}) {
      EXPECT_EQ(std::count(extremes.begin(), extremes.end(), end), 1);
    }
  }
}

TEST(HullVolume, OfNoMorePointsThanDirectionsIsThatOfAll) {
  test::Random random(7);
  std::vector<Vector3d> few;
  for (int i = 0; i < 226; ++i) few.push_back(random.inBox(1.0));
  EXPECT_EQ(extremePoints(few), few);
  few.push_back(Vector3d::Zero());
  EXPECT_LT(extremePoints(few).size(), few.size());
}

TEST(HullVolume, OfFlatPointsIsZero) {
  test::Random random(2);
  std::vector<Vector3d> plane(50, Vector3d(1, 2, 3));
  EXPECT_EQ(hullVolume(plane), 0.0);
  for (auto& p : plane) p.head<2>() = random.inBox(1.0).head<2>();
  EXPECT_EQ(hullVolume(plane), 0.0);
}

TEST(HullVolume, KnowsFlatFromThinAtEverySize) {
  test::Random random(3);
  for (const double size : {1e-5, 1e-2, 1e2, 1e5}) {
    const auto turn = random.rotation();
    std::vector<Vector3d> plane, sheet;
    for (int i = 0; i < 30; ++i) {
      const Vector3d p = random.inBox(size);
      plane.push_back(turn * Vector3d(p.x(), p.y(), 0.0));
      sheet.push_back(turn * Vector3d(p.x(), p.y(), 1e-6 * p.z()));
    }
    EXPECT_EQ(hullVolume(plane), 0.0) << size;
    EXPECT_GT(hullVolume(sheet), 1e-7 * size * size * size) << size;
  }
}

/// Tetrahedra summed over every four points would count overlaps, so the oracle is Monte Carlo: the
/// share of a box's points that no plane through three of the hull's points cuts off.
TEST(HullVolume, AgreesWithCountedPoints) {
  test::Random random(3);
  std::vector<Vector3d> points;
  for (int i = 0; i < 14; ++i) points.push_back(random.inBox(1.0));
  std::vector<std::pair<Vector3d, double>> planes;
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t c = 0; c < points.size(); ++c) {
        const Vector3d n = (points[b] - points[a]).cross(points[c] - points[a]);
        for (const Vector3d& side : {n, Vector3d(-n)}) {
          const double d = side.dot(points[a]);
          const bool bounds =
              n.norm() > 1e-9 && std::all_of(points.begin(), points.end(), [&](const Vector3d& p) {
                return side.dot(p) <= d + 1e-9;
              });
          if (bounds) planes.emplace_back(side, d);
        }
      }
    }
  }
  int inside = 0;
  constexpr int kDarts = 200000;
  for (int i = 0; i < kDarts; ++i) {
    const Vector3d p = random.inBox(1.0);
    inside += std::all_of(planes.begin(), planes.end(),
                          [&](const auto& plane) { return plane.first.dot(p) <= plane.second; });
  }
  EXPECT_GT(inside, kDarts / 20);
  EXPECT_NEAR(hullVolume(points), 8.0 * inside / kDarts, 0.03);
}

}  // namespace
}  // namespace foretouch
