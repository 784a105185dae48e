// Parts of a mesh and an LSS of another link at one instant, against fifty digits: the pads cover
// what separates the floats from the true motion, and what lanes prove is true of it.
#include "middleware/query/still_lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "judge/plain_distance.h"
#include "judge/plain_motion.h"
#include "lss/simd.h"
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

TEST(StillLanes, PadsCoverTheWayFromFloatsToTheTrueMotion) {
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
class StillLanesAtWidth : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

std::string nameOf(const testing::TestParamInfo<Simd>& info) {
  return toString(info.param);
}

TEST_P(StillLanesAtWidth, ProveNoMoreThanIsTrue) {
  StillLanes lanes;
  int proven = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TwoLinks links(random);
    std::array<Lss, kTrianglePairLanes> lss;
    std::array<Triangle, kTrianglePairLanes> triangles;
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      lss[lane] = randomLss(random);
      // Most triangles lie near the LSS: there a pad decides.
      const Precise3 there = links.inMesh(random.chance(0.5) ? lss[lane].a : lss[lane].b);
      const Vector3d beside(static_cast<double>(there.x), static_cast<double>(there.y),
                            static_cast<double>(there.z));
      const Vector3d middle = beside + random.magnitude(1e-6, 0.5) * random.direction();
      const double size = random.magnitude(1e-4, 0.1);
      for (Vector3d& v : triangles[lane].vertices) v = middle + size * random.inBox(1.0);
      lss[lane].radius = random.magnitude(1e-6, 1e-2);
      lanes.put(lane, links.axis(lss[lane]), lanePart(triangles[lane]));
    }
    lanes.prove(kTrianglePairLanes);
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      const auto& v = triangles[lane].vertices;
      const Precise3 a = links.inMesh(lss[lane].a), b = links.inMesh(lss[lane].b);
      const Real distance =
          oracle::preciseDistance({a, b, b}, {Precise3(v[0]), Precise3(v[1]), Precise3(v[2])}) -
          Real(lss[lane].radius);
      ASSERT_LE(Real(lanes.lower(lane)), distance);
      if (lanes.lower(lane) > 0.0) {
        ++proven;
        // Floats resolve 6e-8 of the distance from the mesh's own origin; a root may be 10 km away
        // from another.
        const double far = lss[lane].a.norm() + static_cast<double>(norm(a)) + v[0].norm();
        EXPECT_LE(distance - Real(lanes.lower(lane)), Real(1e-5 * far + 1e-6));
      }
    }
  }
  EXPECT_GT(proven, 1000);
}

INSTANTIATE_TEST_SUITE_P(Widths, StillLanesAtWidth, testing::ValuesIn(supportedSimd()), nameOf);

}  // namespace
}  // namespace foretouch::internal
