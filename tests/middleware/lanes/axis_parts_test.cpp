// Parts of a mesh and an LSS of another link at one instant, against fifty digits: the pads cover
// what separates the floats from the true motion, and what lanes prove is true of it.
#include "middleware/lanes/axis_parts.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "judge/plain_distance.h"
#include "judge/plain_motion.h"
#include "lss/simd.h"
#include "middleware/lanes/frame_lanes.h"
#include "middleware/pair/still_axis.h"
#include "tests/support/name_of_simd.h"
#include "tests/support/random_motion.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;

/// Two links of a moving tree at one instant, as computed and in fifty digits. A fifth of the roots
/// are ten kilometres from the world's origin.
struct TwoLinks {
  test::RandomMotion tree;
  ChainMotion motion;
  LinkId plain = 0, mesh = 1;
  double t = 0.0;
  oracle::PreciseFrame truePlain, trueMesh;

  explicit TwoLinks(Random& random) : tree(test::randomMotion(random, 2 + random.below(4))) {
    motion.assign(tree.skeleton, tree.from, tree.to);
    plain = random.below(motion.numLinks());
    mesh = (plain + 1 + random.below(motion.numLinks() - 1)) % motion.numLinks();
    t = random.chance(0.5) ? 0.0 : random.uniform(0.0, 1.0);
    const auto frames = oracle::preciseFrames(tree.precise, Real(t));
    truePlain = frames[static_cast<std::size_t>(plain)];
    trueMesh = frames[static_cast<std::size_t>(mesh)];
  }

  [[nodiscard]] StillAxis axis(const Lss& lss) const {
    return stillAxis(lss, motion.stateAt(plain, t), axisBounds(lss, motion.bounds(plain)),
                     motion.stateAt(mesh, t), motion.bounds(mesh));
  }
  /// Of a point of the plain link, in the mesh's true frame.
  [[nodiscard]] Precise3 inMesh(const Vector3d& p_L) const {
    return rotate(conjugate(trueMesh.rotation), truePlain.at(p_L) - trueMesh.origin);
  }
};

Vector3d inReach(Random& random) {
  return random.magnitude(1e-3, 0.6) * random.direction();
}

Lss randomLss(Random& random) {
  return {inReach(random), inReach(random), random.magnitude(1e-3, 0.2)};
}

Precise3 precise(const float (&p)[3]) {
  return {Real(p[0]), Real(p[1]), Real(p[2])};
}

TEST(StillAxis, PadsCoverTheWayFromFloatsToTheTrueMotion) {
  double used = 0.0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TwoLinks links(random);
    const Lss lss = randomLss(random);
    const StillAxis axis = links.axis(lss);
    const Triangle triangle{{inReach(random), inReach(random), inReach(random)}};
    const LanePart part = lanePart(triangle);
    const Real pad = Real(axis.pad) + Real(axis.padPerRho) * Real(part.rho);
    const std::array<Vector3d, 2> ends{lss.a, lss.b};
    for (std::size_t i = 0; i < 2; ++i) {
      const Real axisOff = norm(links.inMesh(ends[i]) - precise(axis.point[i]));
      for (std::size_t k = 0; k < 3; ++k) {
        const Real meshOff = norm(Precise3(triangle.vertices[k]) - precise(part.point[k]));
        ASSERT_LE(axisOff + meshOff, pad);
        used = std::max(used, static_cast<double>((axisOff + meshOff) / pad));
      }
    }
    EXPECT_GE(Real(axis.radius), Real(lss.radius));
  }
  EXPECT_GT(used, 0.2) << "a pad that is never needed is not the bound it says";
}

/// Every width of the processor, one after the other.
class AxisPartsAtWidth : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// Parts of the mesh, most of them near the LSS: there a pad decides. Either LSS of it, or one of
/// them at least a triangle.
struct NearParts {
  PartRows rows;
  std::array<std::array<Precise3, 3>, kTrianglePairLanes> points;
  std::array<Real, kTrianglePairLanes> radii;

  NearParts(const TwoLinks& links, const Lss& lss, Random& random) {
    rows.count = 1 + random.below(static_cast<int>(kTrianglePairLanes));
    rows.areAxes = random.chance(0.5);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(rows.count); ++lane) {
      const Precise3 there = links.inMesh(random.chance(0.5) ? lss.a : lss.b);
      const Vector3d middle = Vector3d(static_cast<double>(there.x), static_cast<double>(there.y),
                                       static_cast<double>(there.z)) +
                              random.magnitude(1e-6, 0.5) * random.direction();
      const double size = random.magnitude(1e-4, 0.1);
      const auto point = [&] { return Vector3d(middle + size * random.inBox(1.0)); };
      if (rows.areAxes || random.chance(0.3)) {
        const Lss own{point(), random.chance(0.1) ? middle : point(), random.magnitude(1e-6, 1e-2)};
        put(lane, lanePart(own), {own.a, own.b, own.b}, own.radius);
      } else {
        const Triangle own{{point(), point(), point()}};
        put(lane, lanePart(own), {own.vertices[0], own.vertices[1], own.vertices[2]}, 0.0);
      }
    }
  }

 private:
  void put(std::size_t lane, const LanePart& part, const std::array<Vector3d, 3>& at,
           double radius) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) rows.point[i][k][lane] = part.point[i][k];
      points[lane][i] = Precise3(at[i]);
    }
    rows.rho[lane] = part.rho;
    rows.radius[lane] = part.radius;
    radii[lane] = Real(radius);
  }
};

TEST_P(AxisPartsAtWidth, ProveNoMoreThanIsTrue) {
  int proven = 0, deep = 0, met = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TwoLinks links(random);
    Lss lss = randomLss(random);
    lss.radius = random.magnitude(1e-6, 1e-2);
    const NearParts parts(links, lss, random);
    GapBounds gaps;
    boundGaps(links.axis(lss), parts.rows, gaps);
    const Precise3 a = links.inMesh(lss.a), b = links.inMesh(lss.b);
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(parts.rows.count); ++lane) {
      const Real radii = Real(lss.radius) + parts.radii[lane];
      const Real gap = oracle::preciseDistance({a, b, b}, parts.points[lane]) - radii;
      ASSERT_LE(Real(gaps.lower[lane]), gap);
      ASSERT_GE(Real(gaps.upper[lane]), gap);
      met += Real(gaps.upper[lane]) - gap < Real(1e-4) ? 1 : 0;
      deep += gap < Real(0) ? 1 : 0;
      if (gap <= Real(0)) continue;
      ++proven;
      // Floats resolve 6e-8 of the distance from the mesh's own origin; a root may be 10 km away
      // from another.
      const double far = lss.a.norm() + static_cast<double>(norm(a) + norm(parts.points[lane][0]));
      EXPECT_LE(gap - Real(gaps.lower[lane]), Real(1e-5 * far + 1e-6));
    }
  }
  EXPECT_GT(proven, 1000);
  EXPECT_GT(deep, 50);
  EXPECT_GT(met, 1000) << "points that are never the nearest tell nothing";
}

TEST_P(AxisPartsAtWidth, ProveNothingOfWhatIsNoNumber) {
  Random random(0);
  const TwoLinks links(random);
  const Lss lss = randomLss(random);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0x1p60F}) {
    NearParts parts(links, lss, random);
    const StillAxis axis = links.axis(lss);
    StillAxis off = axis;
    off.point[1][2] = bad;
    parts.rows.point[1][0][0] = bad;
    GapBounds gaps;
    boundGaps(axis, parts.rows, gaps);
    EXPECT_LT(gaps.lower[0], 0.0F);
    EXPECT_GT(gaps.upper[0], 1e10F);
    boundGaps(off, parts.rows, gaps);
    for (std::int32_t lane = 0; lane < parts.rows.count; ++lane) {
      EXPECT_LT(gaps.lower[lane], 0.0F);
      EXPECT_GT(gaps.upper[lane], 1e10F);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Widths, AxisPartsAtWidth, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

}  // namespace
}  // namespace foretouch::internal
