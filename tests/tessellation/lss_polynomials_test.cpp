// Holds the certified polynomials against the true motion in fifty digits, at every vector width
// that the processor has.
#include "tessellation/lss_polynomials.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/support/random_motion.h"
#include "tests/support/widest_afterwards.h"
#include "tests/tessellation/random_lss.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using oracle::PreciseFrame;
using test::asDouble;
using test::Random;
using Real = oracle::Precise;

/// The product of floats is exact in doubles. Not every library's std::fma() of floats is.
float fusedSum(float x, float y, float add) {
  return static_cast<float>(static_cast<double>(x) * static_cast<double>(y) +
                            static_cast<double>(add));
}

float horner(const float* c, float u, bool fused) {
  float sum = c[kCoefficients - 1];
  for (int j = kCoefficients - 2; j >= 0; --j) {
    sum = fused ? fusedSum(sum, u, c[j]) : static_cast<float>(sum * u) + c[j];
  }
  return sum;
}

Precise3 evaluated(const float (*rows)[kCoefficients], float u, bool fused) {
  Precise3 p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = Real(horner(rows[i], u, fused));
  return p;
}

Precise3 vectorOf(const double* v) {
  return {Real(v[0]), Real(v[1]), Real(v[2])};
}

/// |d^order/du^order| of the polynomials, without rounding.
double derivative(const float (*rows)[kCoefficients], int count, float u, int order) {
  Real square = 0;
  for (int row = 0; row < count; ++row) {
    Real sum = 0;
    for (int j = kCoefficients - 1; j >= order; --j) {
      sum = sum * Real(u) + Real(rows[row][j]) * (order == 1 ? j : j * (j - 1));
    }
    square += sum * sum;
  }
  return asDouble(sqrt(square));
}

Real instantOf(const ChainNodes& nodes, float u) {
  return Real(nodes.begin()) + (Real(nodes.end()) - Real(nodes.begin())) * (Real(u) + 1) / 2;
}

/// Often an end of the span or a node, where interpolation has nothing to hide behind.
float randomU(Random& random) {
  switch (random.below(6)) {
    case 0: return -1.0f;
    case 1: return 1.0f;
    case 2: return static_cast<float>(2.0 * ChainNodes::time(random.below(kNodes)) - 1.0);
    default: return static_cast<float>(random.uniform(-1.0, 1.0));
  }
}

struct Shares {
  double lss = 0.0, point = 0.0, speed = 0.0, acceleration = 0.0;
};

void checkDerivative(const float (*rows)[kCoefficients], int count, float u, float speed,
                     float acceleration, Shares& shares) {
  const double first = derivative(rows, count, u, 1), second = derivative(rows, count, u, 2);
  ASSERT_LE(first, static_cast<double>(speed));
  ASSERT_LE(second, static_cast<double>(acceleration));
  shares.speed = std::max(shares.speed, first / static_cast<double>(speed));
  shares.acceleration = std::max(shares.acceleration, second / static_cast<double>(acceleration));
}

void checkLss(const LssTable::Entry& entry, const LssPolynomials& got, const ChainNodes& nodes,
              const PreciseFrame& frame, float u, Shares& shares) {
  const double excess = static_cast<double>(got.radius) - entry.radius;
  const Precise3 origin = Precise3(nodes.origin()) + vectorOf(got.origin);
  for (const double* coordinate : {got.origin, got.origin + 1, got.origin + 2}) {
    ASSERT_EQ(static_cast<double>(static_cast<float>(*coordinate)), *coordinate);
  }
  for (const bool fused : {false, true}) {
    const Precise3 a = frame.at(Vector3d(entry.a)) - origin - evaluated(got.a, u, fused);
    const Precise3 b = frame.at(Vector3d(entry.b)) - origin - evaluated(got.b, u, fused);
    const double off = asDouble(std::max(norm(a), norm(b)));
    ASSERT_LE(off, excess);
    shares.lss = std::max(shares.lss, off / excess);
  }
  checkDerivative(got.a, 3, u, got.speedA, got.accelerationA, shares);
  checkDerivative(got.b, 3, u, got.speedB, got.accelerationB, shares);
}

void checkFrame(const FramePolynomials& got, const ChainNodes& nodes, const PreciseFrame& frame,
                float u, const Vector3d& p_L, Shares& shares) {
  const Precise3 truth = frame.at(p_L) - Precise3(nodes.origin()) - vectorOf(got.origin);
  for (const bool fused : {false, true}) {
    Vector3d point;
    for (int i = 0; i < 3; ++i) {
      float sum = horner(got.p[i], u, fused);
      for (int j = 0; j < 3; ++j) {
        const float entry = horner(got.R[3 * i + j], u, fused);
        const auto coordinate = static_cast<float>(p_L[j]);
        sum =
            fused ? fusedSum(entry, coordinate, sum) : sum + static_cast<float>(entry * coordinate);
      }
      point[i] = static_cast<double>(sum);
    }
    const double bound = static_cast<double>(got.originError) +
                         static_cast<double>(got.rotationError) * p_L.norm() * (1.0 + 1e-15);
    const double off = asDouble(norm(truth - Precise3(point)));
    ASSERT_LE(off, bound);
    shares.point = std::max(shares.point, off / bound);
  }
  checkDerivative(got.p, 3, u, got.originSpeed, got.originAcceleration, shares);
  checkDerivative(got.R, 9, u, got.rotationSpeed, got.rotationAcceleration, shares);
}

// Owns every constant of lss_polynomials.cpp. Large steps over wide spans try the interpolation,
// small ones the rounding.
TEST(LssPolynomials, ContainTheTrueLssAndPointsAtEveryWidth) {
  const test::WidestAfterwards guard;
  Shares shares;
  ChainNodes nodes;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(12));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const double span = random.magnitude(1e-3, 1.0), begin = random.uniform(0.0, 1.0 - span);
    const Vector3d origin =
        random.chance(0.7) ? body.motion.from.translations[0] : random.inBox(1.0);
    const float u = randomU(random);
    const LssTable::Entry& entry = table[random.below(table.size())];
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      nodes.evaluate(motion, begin, begin + span, origin);
      const auto frames = oracle::preciseFrames(body.motion.precise, instantOf(nodes, u));
      const PreciseFrame& frame = frames[static_cast<std::size_t>(entry.link)];
      checkLss(entry, polynomialsOf(entry, motion, nodes), nodes, frame, u, shares);
      if (HasFatalFailure()) return;
      const Vector3d p_L = random.magnitude(1e-3, 1.0) * random.direction();
      checkFrame(framePolynomialsOf(entry.link, motion, nodes), nodes, frame, u, p_L, shares);
      if (HasFatalFailure()) return;
      const LinkId other = table[random.below(table.size())].link;
      const FramePolynomials around = framePolynomialsOf(other, motion, nodes);
      checkFrame(framePolynomialsOf(entry.link, motion, nodes, around.origin), nodes, frame, u, p_L,
                 shares);
      if (HasFatalFailure()) return;
    }
  }
  std::cout << "worst shares of the bounds used: LSS " << shares.lss << ", point " << shares.point
            << ", speed " << shares.speed << ", acceleration " << shares.acceleration << "\n";
  EXPECT_GT(shares.lss, 0.02);
  EXPECT_GT(shares.point, 0.02);
  EXPECT_GT(shares.speed, 0.9);
  EXPECT_GT(shares.acceleration, 0.9);
}

// The eighth derivative's bound, where nothing else is of any size: one joint turning a point at
// arm's length comes close to it, and a chain stays below.
TEST(LssPolynomials, InterpolationErrorIsABoundAndNotFarFromTheWorst) {
  ChainNodes nodes;
  double closest = 0.0;
  for (int i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, random.chance(0.7) ? 1 : 1 + random.below(3));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const LssTable::Entry& entry = table[random.below(table.size())];
    nodes.evaluate(motion, 0.0, 1.0, body.motion.from.translations[0]);
    const LssPolynomials got = polynomialsOf(entry, motion, nodes);
    const double bound = interpolationError(motion.bounds(entry.link), entry.rhoA, 1.0);
    const double rounding =
        static_cast<double>(got.radius) - entry.radius -
        std::max(bound, interpolationError(motion.bounds(entry.link), entry.rhoB, 1.0));
    if (bound < 1e3 * rounding || bound < 1e-5) continue;
    for (int k = 0; k < 24; ++k) {
      const auto u = static_cast<float>(random.uniform(-1.0, 1.0));
      const auto frames = oracle::preciseFrames(body.motion.precise, instantOf(nodes, u));
      const Precise3 off = frames[static_cast<std::size_t>(entry.link)].at(Vector3d(entry.a)) -
                           Precise3(nodes.origin()) - vectorOf(got.origin) -
                           evaluated(got.a, u, true);
      const double error = asDouble(norm(off));
      ASSERT_LE(error, bound + rounding);
      closest = std::max(closest, error / bound);
    }
  }
  std::cout << "closest to the bound of the interpolation error: " << closest << "\n";
  EXPECT_GT(closest, 0.2);
}

// Of a body that is only shifted, nothing else is of any size. The least that the derivation (4)
// asks of the radius is 2j + 2 roundings of the j-th coefficient, and products of two of them.
TEST(LssPolynomials, HoldTheRoundingsOfTheirEvaluation) {
  RawSkeleton raw;
  raw.joints = {{"only", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  const Avatar avatar =
      Avatar::build(skeleton, {{{Vector3d::Zero(), Vector3d::Zero(), 0.0}}}).value();
  const Pose from = restPose(skeleton);
  ChainNodes nodes;
  for (const double shift : {1e-3, 1.0, 100.0}) {
    SCOPED_TRACE(shift);
    Pose to = from;
    to.translations[0] = Vector3d(2, -1, 2) * shift;
    const ChainMotion motion(skeleton, from, to);
    nodes.evaluate(motion, 0.0, 1.0, from.translations[0]);
    const LssPolynomials got = polynomialsOf(LssTable(avatar)[0], motion, nodes);
    double weighted = 0.0;
    for (int j = 0; j < kCoefficients; ++j) {
      const Vector3d coefficient(static_cast<double>(got.a[0][j]), static_cast<double>(got.a[1][j]),
                                 static_cast<double>(got.a[2][j]));
      weighted += (2.0 * j + 2.0) * coefficient.norm();
    }
    const double least = 0x1p-24 * (1.0 + 15.0 * 0x1p-24) * weighted;
    EXPECT_GE(static_cast<double>(got.radius), least);
    EXPECT_LE(static_cast<double>(got.radius), 1.001 * least);
  }
}

// An ordinary step of a tracked person: 5 Hz, joints turning up to 15 degrees, within a metre of
// the origin.
TEST(LssPolynomials, CostLessThanAMicrometreForOrdinarySteps) {
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    test::MovingBody body(random, 6);
    for (std::size_t j = 0; j < body.motion.from.rotations.size(); ++j) {
      body.motion.to.rotations[j] =
          body.motion.from.rotations[j] * random.turn(random.uniform(0.0, 0.26));
      body.motion.to.translations[j] =
          body.motion.from.translations[j] + (j == 0 ? 0.3 : 0.0) * random.direction();
    }
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    ChainNodes nodes;
    nodes.evaluate(motion, 0.0, 1.0, body.motion.from.translations[0]);
    for (std::int32_t k = 0; k < table.size(); ++k) {
      const LssPolynomials got = polynomialsOf(table[k], motion, nodes);
      worst = std::max(worst, static_cast<double>(got.radius) - table[k].radius);
    }
  }
  std::cout << "worst growth of a radius: " << worst << " m\n";
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(worst, 1e-8);
}

/// Values at x of the eight Lagrange polynomials of the Chebyshev-Lobatto points, in double.
double lebesgueAt(const double* nodes, double x) {
  double sum = 0.0;
  for (int k = 0; k < kNodes; ++k) {
    double value = 1.0;
    for (int other = 0; other < kNodes; ++other) {
      if (other != k) value *= (x - nodes[other]) / (nodes[k] - nodes[other]);
    }
    sum += std::abs(value);
  }
  return sum;
}

// Owns kLebesgue. Where the sum is largest it is a polynomial of degree 7, whose slope is at most
// 49 times its largest value (Markov's inequality): a grid point half a gap away sees all but that
// of it.
TEST(LssPolynomials, ErrorsAtTheNodesGrowByLessThanTheConstant) {
  double nodes[kNodes];
  for (int k = 0; k < kNodes; ++k) nodes[k] = 2.0 * ChainNodes::time(k) - 1.0;
  constexpr int kGrid = 20000;
  double largest = 0.0;
  for (int i = 0; i <= kGrid; ++i) {
    largest = std::max(largest, lebesgueAt(nodes, -1.0 + 2.0 * i / kGrid));
  }
  constexpr double kGap = 2.0 / kGrid;
  EXPECT_LE(largest / (1.0 - 49.0 * 0.5 * kGap), 2.5);
  EXPECT_GT(largest, 2.2);
}

TEST(LssTable, HoldsEveryLssInLinkOrder) {
  Random random(3);
  const test::MovingBody body(random, 9);
  const LssTable table(body.avatar);
  ASSERT_EQ(table.numLinks(), body.avatar.numLinks());
  ASSERT_EQ(table.size(), body.avatar.numLss());
  for (LinkId link = 0; link < table.numLinks(); ++link) {
    const auto& own = body.avatar.lss(link);
    ASSERT_EQ(table.first(link + 1) - table.first(link), static_cast<std::int32_t>(own.size()));
    for (std::size_t k = 0; k < own.size(); ++k) {
      const auto& entry = table[table.first(link) + static_cast<std::int32_t>(k)];
      EXPECT_EQ(entry.link, link);
      EXPECT_EQ(Vector3d(entry.a), own[k].a);
      EXPECT_EQ(Vector3d(entry.b), own[k].b);
      EXPECT_EQ(entry.radius, own[k].radius);
      EXPECT_GE(entry.rhoA, own[k].a.norm());
      EXPECT_GE(table.rho(link), std::max(entry.rhoA, entry.rhoB));
    }
  }
}

TEST(LssTable, AssignedAnewKeepsNothingOfBefore) {
  Random random(4);
  const test::MovingBody before(random, 9), after(random, 5);
  const auto listsOf = [](const Avatar& avatar) {
    std::vector<std::vector<Lss>> lists;
    for (LinkId link = 0; link < avatar.numLinks(); ++link) lists.push_back(avatar.lss(link));
    lists.front().clear();
    return lists;
  };
  LssTable reused(before.avatar), fresh;
  reused.assign(listsOf(after.avatar));
  fresh.assign(listsOf(after.avatar));
  ASSERT_EQ(reused.numLinks(), 5);
  ASSERT_EQ(reused.size(), fresh.size());
  EXPECT_EQ(reused.bareLinks(), fresh.bareLinks());
  EXPECT_EQ(reused.largestRho(), fresh.largestRho());
  EXPECT_EQ(reused.largestRadius(), fresh.largestRadius());
  double largestRho = 0.0;
  for (LinkId link = 0; link < 5; ++link) {
    EXPECT_EQ(reused.rho(link), fresh.rho(link));
    EXPECT_EQ(reused.first(link + 1), fresh.first(link + 1));
    largestRho = std::max(largestRho, fresh.rho(link));
  }
  EXPECT_EQ(fresh.rho(0), 0.0);
  EXPECT_EQ(fresh.largestRho(), largestRho);
}

TEST(SlabsFor, IsTheLeastPowerOfTwoThatMeetsTheBound) {
  int seen = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(8));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const double wanted = random.magnitude(1e-9, 1e-3);
    const int slabs = slabsFor(table, motion, wanted);
    const auto worst = [&](int n) {
      double error = 0.0;
      for (std::int32_t k = 0; k < table.size(); ++k) {
        const double rho = std::max(table[k].rhoA, table[k].rhoB);
        error = std::max(error, interpolationError(motion.bounds(table[k].link), rho, 1.0 / n));
      }
      return error;
    };
    if (slabs < 16) {
      EXPECT_LE(worst(slabs), wanted * (1.0 + 1e-9));
    }
    if (slabs > 1) {
      EXPECT_GT(worst(slabs / 2), wanted * (1.0 - 1e-9));
    }
    seen |= slabs;
  }
  EXPECT_EQ(seen, 31) << "every number of slabs should occur";
  Random random(0);
  const test::MovingBody body(random, 8);
  const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
  EXPECT_EQ(slabsFor(LssTable(body.avatar), motion, 0.0), 16) << "no number of slabs would do";
}

}  // namespace
}  // namespace foretouch
