// Holds the frames at nodes and their bounds against fifty-digit forward kinematics, at every
// vector width that the processor has.
#include "articulated/chain_nodes.h"

#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/support/random_motion.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using test::asDouble;
using test::Random;
using test::RandomMotion;
using Real = oracle::Precise;

/// Worst share of each bound that was used.
struct NodeShares {
  double position = 0.0, rotation = 0.0;
};

Precise3 rowOf(const LinkNodes& link, int row, int k) {
  return {Real(link.R[3 * row][k]), Real(link.R[3 * row + 1][k]), Real(link.R[3 * row + 2][k])};
}

/// The computed matrix times a vector, in fifty digits.
Precise3 rotated(const LinkNodes& link, int k, const Precise3& v) {
  return {dot(rowOf(link, 0, k), v), dot(rowOf(link, 1, k), v), dot(rowOf(link, 2, k), v)};
}

void compare(const RandomMotion& m, const ChainNodes& nodes, int k, Random& random,
             NodeShares& shares) {
  const auto frames = oracle::preciseFrames(m.precise, Real(nodes.instant(k)));
  const Precise3 origin(nodes.origin());
  for (LinkId link = 0; link < nodes.numLinks(); ++link) {
    SCOPED_TRACE(link);
    const LinkNodes& got = nodes.link(link);
    const auto& frame = frames[static_cast<std::size_t>(link)];
    const Precise3 p(Vector3d(got.p[0][k], got.p[1][k], got.p[2][k]));
    const double moved = asDouble(norm(p - (frame.origin - origin)));
    ASSERT_LE(moved, nodes.bounds().positionRounding);
    if (moved > 0.0)
      shares.position = std::max(shares.position, moved / nodes.bounds().positionRounding);
    ASSERT_LE(asDouble(norm(p)), nodes.bounds().reach + nodes.bounds().positionRounding);
    const Precise3 unit(random.direction());
    const double turned =
        asDouble(norm(rotated(got, k, unit) - oracle::rotate(frame.rotation, unit)));
    ASSERT_LE(turned, nodes.bounds().rotationRounding * (1.0 + 1e-12));
    shares.rotation = std::max(shares.rotation, turned / nodes.bounds().rotationRounding);
    const double normSquare = got.q[0][k] * got.q[0][k] + got.q[1][k] * got.q[1][k] +
                              got.q[2][k] * got.q[2][k] + got.q[3][k] * got.q[3][k];
    ASSERT_NEAR(normSquare, 1.0, nodes.bounds().rotationRounding);
  }
}

// Owns kQuaternion, kMatrix, kArm and kSum of chain_nodes.cpp and the length of the weights'
// series.
TEST(ChainNodes, AreTheTrueFramesWithinTheirBoundsAtEveryWidth) {
  const test::WidestAfterwards guard;
  NodeShares shares;
  ChainNodes nodes;
  for (int i = 0; i < 240; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(12));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    const double begin = random.chance(0.5) ? 0.0 : random.below(16) / 16.0;
    const double end = random.chance(0.5) ? 1.0 : begin + (1.0 - begin) * random.uniform(0.01, 1.0);
    const Vector3d origin = random.chance(0.5) ? m.from.translations[0] : random.inBox(1.0);
    const int k = random.below(kNodes);
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      nodes.evaluate(motion, begin, end, origin);
      ASSERT_EQ(nodes.instant(0), begin);
      ASSERT_EQ(nodes.instant(kNodes - 1), end);
      compare(m, nodes, k, random, shares);
      if (HasFatalFailure()) return;
    }
  }
  std::cout << "worst shares of the rounding bounds used: position " << shares.position
            << ", rotation " << shares.rotation << "\n";
  for (const double share : {shares.position, shares.rotation}) {
    EXPECT_LT(share, 0.5);
    EXPECT_GT(share, 1e-3) << "the test no longer sees any rounding";
  }
}

// One joint, turns of every size up to a half: the series has to be long enough for each.
TEST(ChainNodes, TurnsOfEverySizeAreReached) {
  ChainNodes nodes;
  NodeShares shares;
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    RandomMotion m = test::randomMotion(random, 1);
    constexpr double kPi = 3.14159265358979323846;
    const double angle =
        i % 10 == 0 ? kPi : (i % 2 == 0 ? random.uniform(0, kPi) : random.magnitude(1e-16, kPi));
    m.to.rotations[0] = m.from.rotations[0] * random.turn(angle);
    m.precise = test::plainJoints(m.skeleton, m.from, m.to);
    nodes.evaluate(ChainMotion(m.skeleton, m.from, m.to), 0.0, 1.0, Vector3d::Zero());
    compare(m, nodes, 1 + random.below(kNodes - 2), random, shares);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(shares.rotation, 1e-3);
}

TEST(ChainNodes, TimesAreTheChebyshevLobattoPoints) {
  const Real pi = Real::pi();
  for (int k = 0; k < kNodes; ++k) {
    const Real exact = (1 - cos(Real(k) * pi / 7)) / 2;
    EXPECT_EQ(ChainNodes::time(k), asDouble(exact)) << k;
  }
}

TEST(ChainNodes, InstantsStayCloseToTheirFormula) {
  ChainNodes nodes;
  Random random(1);
  const RandomMotion m = test::randomMotion(random, 1);
  const ChainMotion motion(m.skeleton, m.from, m.to);
  for (int i = 0; i < 200; ++i) {
    const double begin = random.uniform(0.0, 0.99), end = random.uniform(begin + 1e-6, 1.0);
    nodes.evaluate(motion, begin, end, Vector3d::Zero());
    for (int k = 0; k < kNodes; ++k) {
      const Real exact =
          Real(begin) + (Real(end) - Real(begin)) * ((1 - cos(Real(k) * Real::pi() / 7)) / 2);
      EXPECT_LE(asDouble(abs(Real(nodes.instant(k)) - exact)), 0x1p-52);
    }
  }
}

// Reuse must not leave anything of an earlier, larger or faster motion behind.
TEST(ChainNodes, DependOnTheLastCallAlone) {
  ChainNodes reused;
  ChainMotion motion;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(12));
    motion.assign(m.skeleton, m.from, m.to);
    const double end = random.chance(0.5) ? 1.0 : 0.5;
    reused.evaluate(motion, 0.0, end, Vector3d::Zero());
    ChainNodes fresh;
    fresh.evaluate(ChainMotion(m.skeleton, m.from, m.to), 0.0, end, Vector3d::Zero());
    ASSERT_EQ(reused.numLinks(), fresh.numLinks());
    for (LinkId link = 0; link < fresh.numLinks(); ++link) {
      for (int k = 0; k < kNodes; ++k) {
        for (int row = 0; row < 3; ++row)
          ASSERT_EQ(reused.link(link).p[row][k], fresh.link(link).p[row][k]);
        for (int row = 0; row < 9; ++row)
          ASSERT_EQ(reused.link(link).R[row][k], fresh.link(link).R[row][k]);
      }
      ASSERT_EQ(reused.bounds().positionRounding, fresh.bounds().positionRounding);
      ASSERT_EQ(motion.bounds(link).eighthDerivative,
                ChainMotion(m.skeleton, m.from, m.to).bounds(link).eighthDerivative);
    }
  }
}

// Poses are those of the motion; at its ends, those that are given, bit for bit, as quaternions
// that may be turned round.
TEST(ChainNodes, PosesAtInstantsAreThoseOfTheMotion) {
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(12));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    const double t = random.uniform(0.0, 1.0);
    Pose from, to, early, late, truth;
    ChainNodes::posesAt(motion, 0.0, t, from, early);
    ChainNodes::posesAt(motion, t, 1.0, late, to);
    motion.poseAt(t, truth);
    for (std::size_t j = 0; j < truth.rotations.size(); ++j) {
      const JointArc arc = motion.arc(static_cast<LinkId>(j));
      const Quaternion start(arc.from[0], arc.from[1], arc.from[2], arc.from[3]);
      const Quaternion end(arc.to[0], arc.to[1], arc.to[2], arc.to[3]);
      ASSERT_EQ(from.rotations[j].coeffs(), start.coeffs());
      ASSERT_EQ(to.rotations[j].coeffs(), end.coeffs());
      ASSERT_EQ(from.translations[j], m.from.translations[j]);
      ASSERT_EQ(early.rotations[j].coeffs(), late.rotations[j].coeffs());
      ASSERT_NEAR(std::abs(early.rotations[j].dot(truth.rotations[j])), 1.0, 1e-14);
      ASSERT_LE((early.translations[j] - truth.translations[j]).norm(),
                1e-15 * truth.translations[j].norm());
      Real square = 0;
      for (const double q : early.rotations[j].coeffs()) square += Real(q) * Real(q);
      ASSERT_LE(asDouble(abs(square - 1)), 6.0 * kUnitRoundoff);
    }
  }
}

// What MotionEvaluator keeps must not show.
TEST(MotionEvaluator, GivesTheMotionsStatesBitForBit) {
  MotionEvaluator evaluator;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + random.below(12));
    const ChainMotion motion(m.skeleton, m.from, m.to);
    evaluator.reset(motion);
    std::vector<LinkState> kept, once;
    for (const double t : {0.0, random.uniform(0, 1), 1.0}) {
      const LinkId link = random.below(motion.numLinks());
      ASSERT_EQ(evaluator.stateAt(link, t).R_WL, motion.stateAt(link, t).R_WL);
      evaluator.statesAt(t, kept);
      motion.statesAt(t, once);
      ASSERT_EQ(kept.size(), once.size());
      for (std::size_t j = 0; j < kept.size(); ++j) {
        ASSERT_EQ(kept[j].R_WL, once[j].R_WL);
        ASSERT_EQ(kept[j].p_WL, once[j].p_WL);
        ASSERT_EQ(kept[j].w_WL, once[j].w_WL);
        ASSERT_EQ(kept[j].v_WL, once[j].v_WL);
      }
    }
  }
}

}  // namespace
}  // namespace foretouch
