// Holds the curves of axes against the true motion in fifty digits, in W and in the frames of links
// above, at every vector width: places, velocities and accelerations within what they say.
#include "tessellation/axis_curve.h"

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
using test::Random;
using Real = oracle::Precise;

double lengthOf(const Precise3& v) {
  return static_cast<double>(oracle::norm(v));
}

/// The point as somebody sees it who rides on `frame`.
Precise3 seenFrom(const PreciseFrame& frame, const Precise3& p) {
  const oracle::PreciseQuaternion& q = frame.rotation;
  return oracle::rotate(oracle::PreciseQuaternion{q.w, -q.x, -q.y, -q.z}, p - frame.origin);
}

/// The polynomials themselves, in fifty digits: place, or a derivative by t.
Precise3 polynomial(const AxisCurve& curve, bool isA, double t, int derivative) {
  const Real x = (Real(t) - Real(curve.begin)) * Real(curve.toX) - 1;
  Precise3 sum(0, 0, 0);
  for (int j = kNodes - 1; j >= derivative; --j) {
    const int factor = derivative == 0 ? 1 : derivative == 1 ? j : j * (j - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum[axis] = sum[axis] * x + Real(curve.coefficients[j][axis + (isA ? 0 : 3)]) * factor;
    }
  }
  Real scale = 1;
  for (int k = 0; k < derivative; ++k) scale *= Real(curve.toX);
  return scale * sum;
}

TEST(AxisCurve, FollowsTheTrueAxisInEveryFrameAtEveryWidth) {
  const test::WidestAfterwards guard;
  ChainNodes nodes;
  double worstPlace = 0.0, worstRate = 0.0, worstBend = 0.0;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 2 + random.below(8));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const double span = random.chance(0.3) ? 1.0 : random.magnitude(1e-3, 1.0);
    const double begin = span == 1.0 ? 0.0 : random.uniform(0.0, 1.0 - span);
    const LssTable::Entry& entry = table[random.below(table.size())];
    LinkId frame = entry.link;
    for (int up = random.below(4); up > 0 && frame != kNoParent; --up) {
      frame = motion.parent(frame);
    }
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      nodes.evaluate(motion, begin, begin + span, Vector3d::Zero());
      const AxisCurve curve = axisCurve(entry, motion.sumsIn(frame, entry.link).bounds(), nodes,
                                        frame == kNoParent ? nullptr : &nodes.link(frame));
      for (int sample = 0; sample < 6; ++sample) {
        const double t = sample < 2 ? (sample == 0 ? begin : begin + span)
                                    : begin + span * random.uniform(0.0, 1.0);
        const auto frames = oracle::preciseFrames(body.motion.precise, Real(t));
        const AxisCurve::Ends ends = curve.endsAt(t);
        for (const bool isA : {true, false}) {
          Precise3 truth =
              frames[static_cast<std::size_t>(entry.link)].at(Vector3d(isA ? entry.a : entry.b));
          if (frame != kNoParent) truth = seenFrom(frames[static_cast<std::size_t>(frame)], truth);
          const double off = lengthOf(Precise3(isA ? ends.a : ends.b) - truth);
          ASSERT_LE(off, curve.error);
          worstPlace = std::max(worstPlace, off / curve.error);
          const Precise3 rate = polynomial(curve, isA, t, 1);
          const double rateOff = lengthOf(Precise3(isA ? ends.velocityA : ends.velocityB) - rate);
          ASSERT_LE(rateOff, curve.velocityRounding + 1e-300);
          if (curve.velocityRounding > 0.0) {
            worstRate = std::max(worstRate, rateOff / curve.velocityRounding);
          }
          const double bend = lengthOf(polynomial(curve, isA, t, 2));
          const double most = isA ? curve.accelerationA : curve.accelerationB;
          ASSERT_LE(bend, most);
          if (most > 1e-9) worstBend = std::max(worstBend, bend / most);
        }
      }
    }
  }
  std::cout << "worst shares used: place " << worstPlace << ", velocity " << worstRate
            << ", acceleration " << worstBend << "\n";
  EXPECT_GT(worstPlace, 0.05) << "the test no longer sees any error";
  EXPECT_GT(worstBend, 0.8) << "the bound is far above every path";
}

// A body at rest, far out: nothing but the rounding of places is of any size. Of an end and of its
// frame's origin, and of their difference, as errors at the nodes may grow in between (5).
TEST(AxisCurve, CountsTheRoundingOfItsFrameToo) {
  Random random(1);
  const test::MovingBody body(random, 3);
  Pose far = body.motion.from;
  far.translations[0] = Vector3d(1e4, -2e4, 3e4);
  const ChainMotion motion(body.avatar.skeleton(), far, far);
  const LssTable table(body.avatar);
  const LssTable::Entry& entry = table[table.size() - 1];
  ChainNodes nodes;
  nodes.evaluate(motion, 0.0, 1.0, Vector3d::Zero());
  const AxisCurve curve =
      axisCurve(entry, motion.sumsIn(0, entry.link).bounds(), nodes, &nodes.link(0));
  const NodeBounds& at = nodes.bounds();
  const double ofPlaces = 2.0 * at.positionRounding + (32.0 + 4.0) * kUnitRoundoff * at.reach;
  EXPECT_GE(curve.error, 2.203 * ofPlaces);
  EXPECT_LE(curve.error, 3.0 * ofPlaces);
}

}  // namespace
}  // namespace foretouch
