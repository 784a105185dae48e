// Holds the arcs of a step, which are computed many joints at a time, against one joint at a time
// and against fifty digits.
#include "articulated/joint_arcs.h"

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/simd.h"
#include "tests/support/random_motion.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch {
namespace {

using oracle::Precise3;
using test::Random;
using test::RandomMotion;
using Real = oracle::Precise;

void expectSame(const JointArc& got, const JointArc& expected) {
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(got.from[i], expected.from[i]);
    ASSERT_EQ(got.to[i], expected.to[i]);
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(got.translation[i], expected.translation[i]);
    ASSERT_EQ(got.drift[i], expected.drift[i]);
  }
  ASSERT_EQ(got.versine, expected.versine);
  ASSERT_EQ(got.length, expected.length);
  ASSERT_EQ(got.driftLength, expected.driftLength);
}

/// The motion of joint `j` alone, a root.
ChainMotion alone(const RandomMotion& m, JointId j) {
  const auto i = static_cast<std::size_t>(j);
  RawSkeleton raw;
  raw.joints.push_back({"joint", kNoParent, m.from.translations[i], Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  return {skeleton,
          {{m.from.rotations[i]}, {m.from.translations[i]}},
          {{m.to.rotations[i]}, {m.to.translations[i]}}};
}

// Every number of joints that a vector may be left with, and vectors that take joints twice.
TEST(JointArcs, AreTheSameForAnyNumberOfJointsAtEveryWidth) {
  const test::WidestAfterwards guard;
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = test::randomMotion(random, 1 + i % 12);
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      const ChainMotion motion(m.skeleton, m.from, m.to);
      for (JointId j = 0; j < motion.numLinks(); ++j) {
        SCOPED_TRACE(j);
        ASSERT_TRUE(useSimd(supportedSimd().front()));
        const JointArc expected = alone(m, j).arc(0);
        expectSame(motion.arc(j), expected);
        ASSERT_EQ(motion.arc(j).parent, m.skeleton.parent(j));
        if (HasFatalFailure()) return;
      }
    }
  }
}

// Owns kRootInflation and kLeastRoot.
TEST(JointArcs, LengthsAreBoundsAndTight) {
  for (int i = 0; i < 2000; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    RandomMotion m = test::randomMotion(random, 1);
    const double size = random.magnitude(1e-30, 1e7);
    m.from.translations[0] = size * random.direction();
    m.to.translations[0] =
        m.from.translations[0] + random.magnitude(1e-30, size) * random.direction();
    const JointArc arc = ChainMotion(m.skeleton, m.from, m.to).arc(0);
    const Precise3 from(m.from.translations[0]), to(m.to.translations[0]);
    const Real length = std::max(norm(from), norm(to)), drift = norm(to - from);
    constexpr double kSlack =
        1e-15;  // of the sum translation + drift, which is what has to be bounded
    EXPECT_GE(Real(arc.length), length * (1 - kSlack));
    EXPECT_LE(Real(arc.length), length * (1 + 3e-7) + Real(2e-19));
    EXPECT_GE(Real(arc.driftLength), drift * (1 - kSlack) - length * kSlack);
    EXPECT_LE(Real(arc.driftLength), drift * (1 + 3e-7) + length * kSlack + Real(2e-19));
  }
}

// Who takes a joint for one that keeps its translation leaves its drift out.
TEST(JointArcs, OnlyJointsThatKeepTheirTranslationHaveNoDrift) {
  Random random(1);
  RandomMotion m = test::randomMotion(random, 7);
  m.to.translations = m.from.translations;
  m.from.translations[3].y() = 0.0;
  m.to.translations[3].y() = 1e-300;  // whose square is zero
  const ChainMotion motion(m.skeleton, m.from, m.to);
  EXPECT_GT(motion.arc(3).driftLength, 0.0);
  EXPECT_EQ(motion.arc(6).driftLength, 0.0);
}

}  // namespace
}  // namespace foretouch
