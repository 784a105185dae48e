// Points of a link in lanes against fifty digits: places, velocities and bounds, at every width;
// and what parts in lanes prove against the true motion.
#include "middleware/lanes/frame_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "judge/plain_motion.h"
#include "lss/simd.h"
#include "middleware/pair/lane_backtracking.h"
#include "middleware/pair/part_lanes.h"
#include "tests/support/name_of_simd.h"
#include "tests/support/random_motion.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;

constexpr double kUnit = 0x1p-24;

/// Every width of the processor, one after the other.
class FrameLanes : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

/// A chain's last link over one of the spans that queries use.
struct MovingLink {
  test::RandomMotion chain;
  ChainMotion motion;
  ChainNodes nodes;
  LinkId link = 0;
  double begin = 0.0, end = 1.0;
  FramePolynomials polynomials{};

  explicit MovingLink(Random& random) : chain(test::randomMotion(random, 1 + random.below(4))) {
    motion.assign(chain.skeleton, chain.from, chain.to);
    link = motion.numLinks() - 1;
    const int slabs = 1 << random.below(5), slab = random.below(slabs);
    begin = static_cast<double>(slab) / slabs;
    end = static_cast<double>(slab + 1) / slabs;
    const Vector3d near = motion.stateAt(link, 0.5).p_WL + random.inBox(2.0);
    nodes.evaluate(motion, begin, end, near);
    polynomials = framePolynomialsOf(link, motion, nodes);
  }

  [[nodiscard]] Real timeOf(float u) const {
    return Real(begin) + (Real(u) + 1) * (Real(end) - Real(begin)) / 2;
  }
  /// The true place of a point of the link.
  [[nodiscard]] Precise3 placeOf(const Vector3d& p_L, const Real& t) const {
    return oracle::preciseFrames(chain.precise, t)[static_cast<std::size_t>(link)].at(p_L);
  }
  /// What the lanes' places are relative to.
  [[nodiscard]] Precise3 origin() const {
    const auto& p = polynomials.origin;
    return Precise3(nodes.origin()) + Precise3(Vector3d(p[0], p[1], p[2]));
  }
};

Triangle randomPart(Random& random) {
  const double size = random.magnitude(1e-3, 0.5);
  const Vector3d middle = random.uniform(0.0, 0.6) * random.direction();
  return {{middle + size * random.inBox(1.0), middle + size * random.inBox(1.0),
           middle + size * random.inBox(1.0)}};
}

void put(const LanePart& part, float u, float scenePad, std::size_t lane, PartBlock& block) {
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) block.point[i][axis][lane] = part.point[i][axis];
  }
  block.u[lane] = u;
  block.rho[lane] = part.rho;
  block.scenePad[lane] = scenePad;
}

Precise3 pointIn(const TrianglePairBlock& pairs, int i, std::size_t lane) {
  const auto& p = pairs.link[i];
  return {Real(p[0][lane]), Real(p[1][lane]), Real(p[2][lane])};
}

TEST_P(FrameLanes, PlacePointsWithinThePadOfTheTrueMotion) {
  double used = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const MovingLink moving(random);
    const LaneFrame frame = laneFrame(moving.polynomials);
    std::array<Triangle, kTrianglePairLanes> parts;
    PartBlock block{};
    TrianglePairBlock pairs{};
    const float scenePad = random.chance(0.5) ? 0.0F : 1e-4F;
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      parts[lane] = randomPart(random);
      put(lanePart(parts[lane]), test::randomInstant(random), scenePad, lane, block);
    }
    placeParts(frame, block, kTrianglePairLanes, pairs);
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      const Real t = moving.timeOf(block.u[lane]);
      for (int i = 0; i < 3; ++i) {
        const Precise3 there = moving.placeOf(parts[lane].vertices[i], t) - moving.origin();
        const Real off = norm(there - pointIn(pairs, i, lane));
        ASSERT_LE(off + Real(scenePad), Real(pairs.positionPad[lane]));
        used = std::max(
            used, static_cast<double>(off / (Real(pairs.positionPad[lane]) - Real(scenePad))));
      }
    }
  }
  EXPECT_GT(used, 0.02) << "a pad that is never needed is not the bound it says";
}

/// The polynomial body's own derivatives, in fifty digits.
struct Derivatives {
  Precise3 first, second;
};
Derivatives derivativesOf(const LaneFrame& frame, const LanePart& part, int i, float u) {
  const auto along = [u](const float(&c)[kCoefficients], int order) {
    Real sum = 0, power = 1;
    for (int k = order; k < kCoefficients; ++k, power *= Real(u)) {
      sum += Real(order == 1 ? k : k * (k - 1)) * Real(c[k]) * power;
    }
    return sum;
  };
  const auto of = [&](int order) {
    Precise3 sum;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] = along(frame.p[axis], order);
      for (std::size_t k = 0; k < 3; ++k) {
        sum[axis] += along(frame.R[3 * axis + k], order) * Real(part.point[i][k]);
      }
    }
    return sum;
  };
  return {of(1), of(2)};
}

TEST_P(FrameLanes, KnowVelocitiesAndBoundAccelerations) {
  double used = 0.0, accelerated = 0.0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(1000 + seed);
    const MovingLink moving(random);
    const LaneFrame frame = laneFrame(moving.polynomials);
    std::array<LanePart, kTrianglePairLanes> parts;
    PartBlock block{};
    TrianglePairBlock pairs{};
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      parts[lane] = lanePart(randomPart(random));
      put(parts[lane], test::randomInstant(random), 0.0F, lane, block);
    }
    placeParts(frame, block, kTrianglePairLanes, pairs);
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      for (int i = 0; i < 3; ++i) {
        const Derivatives true_ = derivativesOf(frame, parts[lane], i, block.u[lane]);
        const auto& v = pairs.velocity[i];
        const Real off =
            norm(true_.first - Precise3(Real(v[0][lane]), Real(v[1][lane]), Real(v[2][lane])));
        ASSERT_LE(off, Real(pairs.velocityPad[lane]));
        ASSERT_LE(norm(true_.second), Real(pairs.acceleration[i][lane]));
        used = std::max(used, static_cast<double>(off / Real(pairs.velocityPad[lane])));
        accelerated = std::max(accelerated, static_cast<double>(norm(true_.second) /
                                                                Real(pairs.acceleration[i][lane])));
      }
    }
  }
  EXPECT_GT(used, 0.01);
  EXPECT_GT(accelerated, 0.2);
}

TEST_P(FrameLanes, ProveGapsAndStepsThatTheTrueMotionKeeps) {
  int proved = 0, stepped = 0, near = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(2000 + seed);
    const bool areLss = seed % 2 == 0;
    const MovingLink moving(random);
    PartLanes lanes;
    lanes.reset(moving.polynomials, moving.nodes.origin(), moving.begin, moving.end);
    std::array<Triangle, kTrianglePairLanes> parts, scene;
    std::array<double, kTrianglePairLanes> from{}, floors{}, radius{};
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      parts[lane] = randomPart(random);
      from[lane] = moving.begin + random.uniform(0.0, 0.9) * (moving.end - moving.begin);
      const Vector3d place =
          moving.motion.stateAt(moving.link, from[lane]).pointAt(parts[lane].vertices[0]);
      const Vector3d shift = random.magnitude(1e-4, 0.5) * random.direction();
      for (Vector3d& v : scene[lane].vertices) {
        v = place + shift + random.magnitude(1e-3, 2.0) * random.inBox(1.0);
      }
      LanePart part = lanePart(parts[lane]);
      if (areLss) {
        radius[lane] = random.magnitude(1e-3, 0.1);
        part = lanePart(Lss{parts[lane].vertices[0], parts[lane].vertices[1], radius[lane]});
        parts[lane].vertices[2] = parts[lane].vertices[1];
      }
      floors[lane] = static_cast<float>(random.magnitude(1e-6, 1e-2));
      const float u = lanes.laneTime(from[lane]);
      ASSERT_LE(lanes.timeOf(u), from[lane]);
      ASSERT_GT(lanes.timeOf(u), from[lane] - kUnit * (moving.end - moving.begin));
      ASSERT_EQ(Real(lanes.timeOf(u)), moving.timeOf(u));
      from[lane] = lanes.timeOf(u);
      lanes.put(lane, lanes.add(scene[lane]), part, u, static_cast<float>(floors[lane]));
    }
    if (areLss) {
      lanes.proveLss(kTrianglePairLanes);
    } else {
      lanes.proveTriangles(kTrianglePairLanes);
    }
    for (std::size_t lane = 0; lane < kTrianglePairLanes; ++lane) {
      const std::array<Precise3, 3> fixed{Precise3(scene[lane].vertices[0]),
                                          Precise3(scene[lane].vertices[1]),
                                          Precise3(scene[lane].vertices[2])};
      const auto separationAt = [&](double t) {
        const auto at = [&](int i) { return moving.placeOf(parts[lane].vertices[i], Real(t)); };
        return preciseDistance({at(0), at(1), at(2)}, fixed) - Real(radius[lane]);
      };
      const Real now = separationAt(from[lane]);
      if (lanes.lower(lane) > 0.0) {
        ASSERT_LE(Real(lanes.lower(lane)), now);
      }
      proved += lanes.lower(lane) > 0.0 ? 1 : 0;
      near += lanes.lower(lane) > static_cast<double>(now) - 1e-4 * (1.0 + radius[lane]) ? 1 : 0;
      const double until = lanes.freeUntil(lane);
      ASSERT_LE(until, moving.end);
      if (!(until > from[lane])) continue;
      ++stepped;
      for (const double share : {0.0, 0.3, 0.8, 0.97, 1.0}) {
        const double t = from[lane] + share * (until - from[lane]);
        ASSERT_GE(separationAt(std::min(t, until)), Real(floors[lane])) << share;
      }
    }
  }
  EXPECT_GT(proved, 200);
  EXPECT_GT(stepped, 200);
  EXPECT_GT(near, 200);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, FrameLanes, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

TEST(PartLanes, BeginAtInstantsThatAreExactAndNeverLate) {
  Random random(7);
  PartLanes lanes;
  for (int i = 0; i < 20000; ++i) {
    const int slabs = 1 << random.below(5), slab = random.below(slabs);
    const double begin = static_cast<double>(slab) / slabs,
                 end = static_cast<double>(slab + 1) / slabs;
    lanes.reset(FramePolynomials{}, Vector3d::Zero(), begin, end);
    const double t = i % 7 == 0   ? begin
                     : i % 7 == 1 ? std::nextafter(end, 0.0)
                                  : begin + random.magnitude(1e-18, 1.0) * (end - begin) * 0.999;
    const float u = lanes.laneTime(t);
    ASSERT_GE(u, -1.0F);
    ASSERT_LE(u, 1.0F);
    ASSERT_LE(lanes.timeOf(u), t);
    ASSERT_LE(t - lanes.timeOf(u), kUnit * (end - begin));
    ASSERT_EQ(Real(lanes.timeOf(u)), Real(begin) + (Real(u) + 1) * Real(end - begin) / 2);
  }
}

TEST(TimeBuckets, GiveBackAllThatWasPutInEarliestFirstUpToABucket) {
  Random random(11);
  TimeBuckets buckets;
  for (int round = 0; round < 20; ++round) {
    const double begin = random.uniform(0.0, 0.5), end = begin + random.magnitude(0.05, 0.5);
    buckets.reset(begin, end);
    std::vector<double> in, out;
    double latest = begin;
    const auto pop = [&] {
      const PartPair pair = buckets.pop();
      ASSERT_GT(pair.freeUntil, latest - (end - begin) / 64.0);
      latest = std::max(latest, pair.freeUntil);
      out.push_back(pair.freeUntil);
    };
    for (int i = 0; i < 500; ++i) {
      PartPair pair;
      pair.freeUntil = random.uniform(latest, end);  // nothing goes back in time
      in.push_back(pair.freeUntil);
      buckets.push(pair);
      if (random.chance(0.4)) pop();
    }
    while (!buckets.isEmpty()) pop();
    std::sort(in.begin(), in.end());
    std::sort(out.begin(), out.end());
    ASSERT_EQ(in, out);
  }
}

}  // namespace
}  // namespace foretouch::internal
