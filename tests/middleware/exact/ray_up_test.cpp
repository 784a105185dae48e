// A ray straight up and triangles: exact, and of one mind about edges and corners.
#include "middleware/exact/ray_up.h"

#include <gtest/gtest.h>

#include "judge/precise.h"
#include "judge/vector.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using Number = oracle::Exact;
using Point = oracle::Vec3<Number>;

/// By solving for the crossing point in exact numbers; points whose ray meets an edge are left out.
enum class Truth { Misses, Crosses, OnEdge };
Truth truthOf(const Vector3d& p, const Triangle& triangle) {
  const Point q(p);
  const Point a(triangle.vertices[0]), b(triangle.vertices[1]), c(triangle.vertices[2]);
  const auto area = [](const Point& x, const Point& y, const Point& z) {
    return (y.x - x.x) * (z.y - x.y) - (y.y - x.y) * (z.x - x.x);
  };
  const Number whole = area(a, b, c);
  if (whole == Number(0)) return Truth::Misses;
  const Number u = area(b, c, q), v = area(c, a, q), w = area(a, b, q);
  if (u == Number(0) || v == Number(0) || w == Number(0)) return Truth::OnEdge;
  const bool isIn = (u < Number(0)) == (whole < Number(0)) &&
                    (v < Number(0)) == (whole < Number(0)) &&
                    (w < Number(0)) == (whole < Number(0));
  if (!isIn) return Truth::Misses;
  // The height of the plane over q, times `whole`.
  const Number height = u * a.z + v * b.z + w * c.z - whole * q.z;
  return (height > Number(0)) == (whole > Number(0)) ? Truth::Crosses : Truth::Misses;
}

TEST(RayUp, AgreesWithExactNumbers) {
  int crosses = 0, misses = 0, edges = 0;
  for (int i = 0; i < 20000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d far = i % 3 == 0 ? Vector3d(random.inBox(1e6)) : Vector3d(Vector3d::Zero());
    const test::RandomPair pair = test::randomPair(random, 1.0, far);
    const Triangle triangle{pair.v};
    Vector3d p = pair.a;
    if (random.chance(0.3)) {  // nearly in its plane
      p = 0.2 * pair.v[0] + 0.3 * pair.v[1] + 0.5 * pair.v[2];
      p.z() += random.magnitude(1e-16, 1e-3) * (random.chance(0.5) ? 1.0 : -1.0);
    }
    const Truth truth = truthOf(p, triangle);
    const RayUp ray = rayUp(p, triangle);
    if (truth == Truth::OnEdge || ray == RayUp::Touches) {
      ++edges;
      continue;
    }
    ASSERT_EQ(ray == RayUp::Crosses, truth == Truth::Crosses) << i;
    ++(truth == Truth::Crosses ? crosses : misses);
  }
  EXPECT_GT(crosses, 1000);
  EXPECT_GT(misses, 5000);
  EXPECT_GT(edges, 100);
}

// A fan about an axis: of points below its rim, centre and edges, the ray crosses exactly one
// blade.
TEST(RayUp, CrossesASheetOnceWhateverIsAboveThePoint) {
  for (int blades = 3; blades < 9; ++blades) {
    std::vector<Vector3d> rim;
    for (int k = 0; k < blades; ++k) {
      // Multiples of a quarter: edges that are seen along axes and diagonals.
      const double angle = 6.283185307179586 * k / blades;
      rim.emplace_back(std::round(8 * std::cos(angle)) / 4, std::round(8 * std::sin(angle)) / 4,
                       0.25 * k);
    }
    const auto crossings = [&](const Vector3d& p) {
      int count = 0;
      for (int k = 0; k < blades; ++k) {
        const Triangle blade{{Vector3d(0, 0, 1), rim[static_cast<std::size_t>(k)],
                              rim[static_cast<std::size_t>((k + 1) % blades)]}};
        count += rayUp(p, blade) == RayUp::Crosses;
      }
      return count;
    };
    EXPECT_EQ(crossings(Vector3d(0, 0, -3)), 1);  // below the centre
    for (const Vector3d& corner : rim) {
      const Vector3d half(0.5 * corner.x(), 0.5 * corner.y(), -3);
      EXPECT_EQ(crossings(half), 1) << "below an edge";
      const Vector3d beyond(1.5 * corner.x(), 1.5 * corner.y(), -3);
      EXPECT_EQ(crossings(beyond), 0);
    }
  }
}

TEST(RayUp, APointOnTheTriangleTouchesIt) {
  const Triangle triangle{{Vector3d(0, 0, 0), Vector3d(4, 0, 2), Vector3d(0, 4, 2)}};
  EXPECT_EQ(rayUp(Vector3d(1, 1, 1), triangle), RayUp::Touches);
  EXPECT_EQ(rayUp(Vector3d(1, 1, 1 - 1e-15), triangle), RayUp::Crosses);
  EXPECT_EQ(rayUp(Vector3d(1, 1, 1 + 1e-15), triangle), RayUp::Misses);
}

}  // namespace
}  // namespace foretouch::internal
