// Lanes against the oracle's distance, in doubles, on motions that are polynomials by construction.
#include "middleware/lanes/lss_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/scene/culler.h"
#include "tests/support/name_of_simd.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using test::Random;

constexpr int kSamples = 300;
constexpr LaneTolerances kTolerances{2.5e-4F, 7.5e-4F, 0.999e-3F};

/// Every width of the processor, one after the other.
class LanePairs : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

double valueAt(const float (&c)[kCoefficients], double u) {
  double sum = 0.0;
  for (int k = kCoefficients - 1; k >= 0; --k) sum = sum * u + static_cast<double>(c[k]);
  return sum;
}

oracle::Vec3<double> endAt(const float (&c)[3][kCoefficients], double u) {
  return {valueAt(c[0], u), valueAt(c[1], u), valueAt(c[2], u)};
}

double secondDerivativeBound(const float (&c)[3][kCoefficients]) {
  double squared = 0.0;
  for (const auto& row : c) {
    double sum = 0.0;
    for (int k = 2; k < kCoefficients; ++k) {
      sum += k * (k - 1) * std::abs(static_cast<double>(row[k]));
    }
    squared += sum * sum;
  }
  return std::sqrt(squared);
}

double derivativeBound(const float (&c)[3][kCoefficients]) {
  double squared = 0.0;
  for (const auto& row : c) {
    double sum = 0.0;
    for (int k = 1; k < kCoefficients; ++k) sum += k * std::abs(static_cast<double>(row[k]));
    squared += sum * sum;
  }
  return std::sqrt(squared);
}

double weightedSum(const float (&c)[3][kCoefficients]) {
  double sum = 0.0;
  for (int j = 0; j < kCoefficients; ++j) {
    sum += (2 * j + 2) * std::hypot(double{c[0][j]}, double{c[1][j]}, double{c[2][j]});
  }
  return sum;
}

/// An LSS whose ends follow random polynomials. The pad covers Horner's rule in float for sums of
/// coefficients up to about 4 m.
constexpr double kPad = 8e-6;
LssPolynomials randomMotion(Random& random, double radius) {
  LssPolynomials p{};
  const Eigen::Vector3d axis = random.uniform(0.0, 0.4) * random.direction();
  for (int k = 0; k < kCoefficients; ++k) {
    const double size = k == 0 ? 0.5 : 0.6 * std::pow(0.4, k);
    const Eigen::Vector3d common = size * random.inBox(1.0);
    const Eigen::Vector3d own = k == 0 ? axis : Eigen::Vector3d(0.2 * size * random.inBox(1.0));
    for (int i = 0; i < 3; ++i) {
      p.a[i][k] = static_cast<float>(common[i]);
      p.b[i][k] = static_cast<float>(common[i] + own[i]);
    }
  }
  p.radius = floatAbove(radius + kPad);
  p.accelerationA = floatAbove(secondDerivativeBound(p.a));
  p.accelerationB = floatAbove(secondDerivativeBound(p.b));
  p.speedA = floatAbove(derivativeBound(p.a));
  p.speedB = floatAbove(derivativeBound(p.b));
  p.weighted = floatAbove(std::max(weightedSum(p.a), weightedSum(p.b)));
  return p;
}

using Corners = std::array<float, 9>;  // [corner][axis]

Corners randomTriangle(Random& random) {
  const double size = random.magnitude(0.003, 4.0);
  const auto pair = test::randomPair(random, size, random.inBox(0.8));
  Corners vertices{};
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      vertices[3 * corner + axis] = static_cast<float>(pair.v[corner][static_cast<int>(axis)]);
    }
  }
  return vertices;
}

/// Separation of the polynomial LSS and the triangle.
double separationAt(const LssPolynomials& p, double radius, const Corners& v, double u) {
  std::array<oracle::Vec3<double>, 3> triangle;
  for (std::size_t i = 0; i < 3; ++i) triangle[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return oracle::closestPoints(endAt(p.a, u), endAt(p.b, u), triangle).distance - radius;
}

/// Ids are the triangles' places.
std::vector<BvhLeaf> leavesOf(const std::vector<Corners>& triangles) {
  std::vector<BvhLeaf> leaves((triangles.size() + kBvhWidth - 1) / kBvhWidth);
  for (std::size_t i = 0; i < leaves.size() * kBvhWidth; ++i) {
    BvhLeaf& leaf = leaves[i / kBvhWidth];
    const std::size_t from = std::min(i, triangles.size() - 1);
    for (std::size_t k = 0; k < 9; ++k) {
      leaf.vertex[k / 3][k % 3][i % kBvhWidth] = triangles[from][k];
    }
    leaf.id[i % kBvhWidth] = from == i ? static_cast<TriangleId>(i) : -1;
  }
  return leaves;
}

struct Outcome {
  HandedOver handed;
  float best = 1.0F;
  std::uint64_t evaluations = 0;
};

Outcome advance(const LssPolynomials& motion, double radius, const std::vector<Corners>& triangles,
                const LaneTolerances& tolerances) {
  const LaneLss lane = laneLss(motion, radius);
  PairLanes pairs;
  const std::vector<BvhLeaf> leaves = leavesOf(triangles);
  std::vector<LeafPart> parts;
  for (const BvhLeaf& leaf : leaves) {
    parts.push_back({&leaf, static_cast<std::uint8_t>((1U << leaf.count()) - 1U), -1.0F});
  }
  const float origin[3] = {0.0F, 0.0F, 0.0F};
  const FloatBox everywhere{{-1e9F, -1e9F, -1e9F}, {1e9F, 1e9F, 1e9F}};
  pairs.addTriangles(lane, parts.data(), parts.size(), everywhere, origin, 0.0);
  Outcome outcome;
  outcome.evaluations = pairs.advanceTriangles(lane, tolerances, outcome.best, outcome.handed);
  EXPECT_EQ(pairs.count(), 0U);
  return outcome;
}

TEST_P(LanePairs, NeverPassAContactAndHandOverOnlyWhatIsNear) {
  double worstLeft = 0.0;
  std::size_t handedOver = 0, through = 0;
  for (std::uint64_t draw = 0; draw < 600; ++draw) {
    Random random(draw);
    const double radius = random.chance(0.1) ? 0.0 : random.magnitude(1e-3, 0.1);
    const LssPolynomials motion = randomMotion(random, radius);
    std::vector<Corners> triangles(static_cast<std::size_t>(1 + random.below(70)));
    for (Corners& t : triangles) t = randomTriangle(random);
    LaneTolerances tolerances = kTolerances;
    tolerances.contact = -1.0F;  // nothing is dropped
    const Outcome outcome = advance(motion, radius, triangles, tolerances);
    EXPECT_EQ(outcome.best, 1.0F);
    std::vector<double> until(triangles.size(), 1.0);
    for (std::size_t i = 0; i < outcome.handed.count; ++i) {
      const auto key = static_cast<std::size_t>(outcome.handed.key[i]);
      until[key] = static_cast<double>(outcome.handed.time[i]);
      const double there = separationAt(motion, radius, triangles[key], until[key]);
      ASSERT_GE(there, static_cast<double>(outcome.handed.gap[i])) << draw << ' ' << key;
      // A thin lever of extent 4 m and a radius of nothing are the worst of these draws.
      worstLeft = std::max(worstLeft, there);
      ++handedOver;
    }
    through += triangles.size() - outcome.handed.count;
    for (std::size_t key = 0; key < triangles.size(); ++key) {
      for (int sample = 0; sample <= kSamples; ++sample) {
        const double u = -1.0 + (until[key] + 1.0) * sample / kSamples;
        if (u >= until[key] && until[key] < 1.0) break;
        ASSERT_GE(separationAt(motion, radius, triangles[key], u), 2.4999e-4)
            << draw << ' ' << key << " at " << u;
      }
    }
  }
  EXPECT_GT(handedOver, 300U);
  EXPECT_GT(through, 3000U);
  EXPECT_LT(worstLeft, 1e-3);
}

struct Handed {
  float time = 1.0F, gap = 0.0F;  // of a pair that was not handed over: none
};

std::vector<Handed> handedOf(const Outcome& outcome, std::size_t count) {
  std::vector<Handed> handed(count);
  for (std::size_t i = 0; i < outcome.handed.count; ++i) {
    handed[static_cast<std::size_t>(outcome.handed.key[i])] = {outcome.handed.time[i],
                                                               outcome.handed.gap[i]};
  }
  return handed;
}

// Which pairs share a vector depends on what culled them.
TEST_P(LanePairs, TellEachPairTheSameWhateverItsNeighbours) {
  LaneTolerances tolerances = kTolerances;
  tolerances.contact = -1.0F;  // nothing is dropped
  std::size_t handedOver = 0;
  for (std::uint64_t draw = 0; draw < 1500; ++draw) {
    Random random(3000 + draw);
    const double radius = random.magnitude(1e-3, 0.1);
    const LssPolynomials motion = randomMotion(random, radius);
    std::vector<Corners> triangles(static_cast<std::size_t>(2 + random.below(30)));
    for (Corners& t : triangles) t = randomTriangle(random);
    const Outcome outcome = advance(motion, radius, triangles, tolerances);
    const std::vector<Handed> together = handedOf(outcome, triangles.size());
    handedOver += outcome.handed.count;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Handed alone = handedOf(advance(motion, radius, {triangles[i]}, tolerances), 1).front();
      ASSERT_EQ(together[i].time, alone.time) << draw << ' ' << i;
      ASSERT_EQ(together[i].gap, alone.gap) << draw << ' ' << i;
    }
  }
  EXPECT_GT(handedOver, 300U);
}

TEST_P(LanePairs, CallNothingACertainContactThatIsNone) {
  int found = 0;
  for (std::uint64_t draw = 0; draw < 800; ++draw) {
    Random random(1000 + draw);
    const double radius = random.magnitude(1e-3, 0.1);
    const LssPolynomials motion = randomMotion(random, radius);
    std::vector<Corners> triangles(static_cast<std::size_t>(1 + random.below(40)));
    for (Corners& t : triangles) t = randomTriangle(random);
    const Outcome outcome = advance(motion, radius, triangles, kTolerances);
    if (outcome.best == 1.0F) continue;
    ++found;
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& t : triangles) {
      least = std::min(least, separationAt(motion, radius, t, outcome.best));
    }
    EXPECT_LE(least, static_cast<double>(kTolerances.contact)) << draw;
    // The pair itself is there to be confirmed.
    const float* const begin = outcome.handed.time.data();
    EXPECT_NE(std::find(begin, begin + outcome.handed.count, outcome.best),
              begin + outcome.handed.count);
  }
  EXPECT_GT(found, 100);
}

TEST_P(LanePairs, SpheresBoundWhatIsInThem) {
  for (std::uint64_t draw = 0; draw < 300; ++draw) {
    Random random(5000 + draw);
    const double radius = random.magnitude(1e-3, 0.1);
    const LssPolynomials motion = randomMotion(random, radius);
    const LaneLss lane = laneLss(motion, radius);
    PairLanes pairs;
    const auto count = static_cast<std::size_t>(1 + random.below(40));
    std::vector<Cluster> spheres(count);
    const float origin[3] = {0.0F, 0.0F, 0.0F};
    std::vector<std::int32_t> which(count + kMaxLanes);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d centre = random.inBox(1.0);
      which[i] = static_cast<std::int32_t>(count - 1 - i);
      spheres[i] = {{static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                     static_cast<float>(centre.z())},
                    static_cast<float>(random.magnitude(0.002, 0.3))};
    }
    pairs.setSpheres(lane, spheres.data(), which.data(), count, origin, -1.0F);
    std::reverse(spheres.begin(), spheres.end());  // in the order of the keys
    HandedOver handed;
    pairs.advanceSpheres(lane, kTolerances, 3, 1.0F, handed);
    std::vector<double> until(count, 1.0);
    for (std::size_t i = 0; i < handed.count; ++i) {
      until[static_cast<std::size_t>(handed.key[i])] = static_cast<double>(handed.time[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const oracle::Vec3<double> centre{spheres[i].centre[0], spheres[i].centre[1],
                                        spheres[i].centre[2]};
      for (int sample = 0; sample < kSamples; ++sample) {
        const double u = -1.0 + (until[i] + 1.0) * sample / kSamples;
        if (u >= until[i]) break;
        const auto closest =
            oracle::closestPoints(endAt(motion.a, u), endAt(motion.b, u), {centre, centre, centre});
        ASSERT_GE(closest.distance - radius - static_cast<double>(spheres[i].radius), 0.0)
            << draw << ' ' << i << " at " << u;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, LanePairs, testing::ValuesIn(supportedSimd()),
                         test::nameOfSimd);

}  // namespace
}  // namespace foretouch::internal
