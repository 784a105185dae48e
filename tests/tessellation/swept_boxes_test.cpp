// Holds the boxes of floats against the true motion in fifty digits, at every vector width that the
// processor has.
#include "tessellation/swept_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/support/widest_afterwards.h"
#include "tests/tessellation/random_lss.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using oracle::PreciseFrame;
using test::Random;
using Real = oracle::Precise;

/// The extreme points of the true LSS, grown by the margin, are between `lower` and `upper`.
bool contains(const float* lower, const float* upper, const LssTable::Entry& entry,
              const PreciseFrame& frame, const Vector3d& origin, double margin) {
  const Precise3 a = frame.at(Vector3d(entry.a)) - Precise3(origin);
  const Precise3 b = frame.at(Vector3d(entry.b)) - Precise3(origin);
  const Real reach = Real(entry.radius) + Real(margin);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::min(a[axis], b[axis]) - reach < Real(lower[axis])) return false;
    if (std::max(a[axis], b[axis]) + reach > Real(upper[axis])) return false;
  }
  return true;
}

TEST(SweptBoxes, ContainTheTrueLssAtEveryWidth) {
  const test::WidestAfterwards guard;
  ChainNodes nodes;
  SweptBoxes boxes;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(12));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const double span = random.magnitude(1e-3, 1.0), begin = random.uniform(0.0, 1.0 - span);
    const double margin = random.chance(0.5) ? 0.0 : 1e-3;
    const Vector3d origin =
        random.chance(0.5) ? body.motion.from.translations[0] : random.inBox(1.0);
    const int piece = random.below(kNodes - 1);
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      nodes.evaluate(motion, begin, begin + span, origin);
      sweptBoxes(table, motion, nodes, margin, boxes);
      ASSERT_EQ(boxes.count, table.size());
      const double first = nodes.instant(piece), last = nodes.instant(piece + 1);
      const double share = random.chance(0.3) ? random.below(2) : random.uniform(0.0, 1.0);
      const Real t = Real(first) + Real(share) * (Real(last) - Real(first));
      const auto frames = oracle::preciseFrames(body.motion.precise, t);
      for (std::int32_t k = 0; k < table.size(); ++k) {
        SCOPED_TRACE(k);
        const PreciseFrame& frame = frames[static_cast<std::size_t>(table[k].link)];
        const float lower[3] = {boxes.lower[0][k], boxes.lower[1][k], boxes.lower[2][k]};
        const float upper[3] = {boxes.upper[0][k], boxes.upper[1][k], boxes.upper[2][k]};
        ASSERT_TRUE(contains(lower, upper, table[k], frame, origin, margin));
      }
    }
  }
}

// The ends on the way are the true ones within what they say of their own error, and their extents
// bound them, far from the nodes' origin too.
TEST(SweptBoxes, KeepTheEndsThatTheyAreMadeOfAtEveryWidth) {
  const test::WidestAfterwards guard;
  ChainNodes nodes;
  SweptBoxes boxes;
  NodeEnds ends;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(12));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const double span = random.magnitude(1e-3, 1.0), begin = random.uniform(0.0, 1.0 - span);
    const Vector3d origin =
        random.chance(0.5) ? body.motion.from.translations[0] : Vector3d(random.inBox(1e4));
    const int node = random.below(kNodes);
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      nodes.evaluate(motion, begin, begin + span, origin);
      sweptBoxes(table, motion, nodes, 1e-3, boxes, &ends);
      const auto frames = oracle::preciseFrames(body.motion.precise, Real(nodes.instant(node)));
      for (std::int32_t k = 0; k < table.size(); ++k) {
        SCOPED_TRACE(k);
        const PreciseFrame& frame = frames[static_cast<std::size_t>(table[k].link)];
        const auto at = static_cast<std::size_t>(k);
        const Precise3 from = Precise3(origin) + Precise3(Vector3d(ends.origin));
        for (const bool isA : {true, false}) {
          const auto& kept = isA ? ends.axes[at].a : ends.axes[at].b;
          const Precise3 truth = frame.at(Vector3d(isA ? table[k].a : table[k].b)) - from;
          Real extent = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const Real x(kept[axis][node]);
            extent += abs(x);
            EXPECT_LE(abs(x - truth[axis]), Real(0x1p-24) * abs(x) + Real(ends.roundings[at]));
          }
          EXPECT_LE(extent, Real(ends.extents[at]));
        }
      }
    }
  }
}

// Points at rest: their boxes are no larger than they, and what rounds in an extent has nothing to
// hide behind.
TEST(SweptBoxes, ExtentsHoldEndsThatHaveNoRadius) {
  RawSkeleton raw;
  raw.joints = {{"only", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  Random random(6);
  std::vector<Lss> points;
  for (int i = 0; i < 40; ++i) {
    const Vector3d p = random.inBox(3.0);
    points.push_back({p, p, 0.0});
  }
  const LssTable table(Avatar::build(skeleton, {points}).value());
  const ChainMotion motion(skeleton, restPose(skeleton), restPose(skeleton));
  ChainNodes nodes;
  nodes.evaluate(motion, 0.0, 1.0, Vector3d::Zero());
  SweptBoxes boxes;
  NodeEnds ends;
  sweptBoxes(table, motion, nodes, 0.0, boxes, &ends);
  for (std::int32_t k = 0; k < table.size(); ++k) {
    double sum = 0.0;
    for (const auto& axis : ends.axes[slotOf(k)].a) sum += std::abs(static_cast<double>(axis[0]));
    const auto extent = static_cast<double>(ends.extents[slotOf(k)]);
    EXPECT_GE(extent, sum);
    EXPECT_LE(extent, sum * (1.0 + 0x1p-18) + 1e-5);
  }
}

TEST(SweptBoxes, GrowByTheMarginOfTheirLink) {
  SweptBoxes boxes, alike;
  ChainNodes nodes;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(12));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    std::vector<double> margins;
    for (LinkId link = 0; link < table.numLinks(); ++link) {
      margins.push_back(random.magnitude(1e-6, 1.0));
    }
    nodes.evaluate(motion, 0.0, 1.0, Vector3d::Zero());
    sweptBoxes(table, motion, nodes, margins, boxes);
    for (std::int32_t k = 0; k < table.size(); ++k) {
      sweptBoxes(table, motion, nodes, margins[static_cast<std::size_t>(table[k].link)], alike);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(boxes.lower[axis][k], alike.lower[axis][k]);
        ASSERT_EQ(boxes.upper[axis][k], alike.upper[axis][k]);
      }
    }
  }
}

TEST(SweptBoxes, LanesLeftOverAreEmpty) {
  SweptBoxes boxes;
  ChainNodes nodes;
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 1 + random.below(20));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    nodes.evaluate(motion, 0.0, 1.0, Vector3d::Zero());
    sweptBoxes(table, motion, nodes, 0.0, boxes);
    ASSERT_EQ(boxes.capacity % SweptBoxes::kPadding, 0);
    ASSERT_GE(boxes.capacity, boxes.count);
    ASSERT_LT(boxes.capacity, boxes.count + SweptBoxes::kPadding);
    for (std::int32_t k = 0; k < boxes.capacity; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(boxes.lower[axis][k] <= boxes.upper[axis][k], k < boxes.count);
      }
    }
  }
}

// A body at rest: nothing but float's own rounding is added.
TEST(SweptBoxes, AreTightAroundABodyAtRest) {
  Random random(5);
  const test::MovingBody body(random, 6);
  const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.from);
  const LssTable table(body.avatar);
  ChainNodes nodes;
  nodes.evaluate(motion, 0.0, 1.0, body.motion.from.translations[0]);
  SweptBoxes boxes;
  sweptBoxes(table, motion, nodes, 0.0, boxes);
  for (std::int32_t k = 0; k < table.size(); ++k) {
    const LinkState state = motion.stateAt(table[k].link, 0.0);
    const Vector3d a = state.pointAt(Vector3d(table[k].a)) - nodes.origin();
    const Vector3d b = state.pointAt(Vector3d(table[k].b)) - nodes.origin();
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::min(a[axis], b[axis]) - table[k].radius;
      EXPECT_NEAR(static_cast<double>(boxes.lower[axis][k]), low, 1e-6 * (1.0 + std::abs(low)));
    }
  }
}

}  // namespace
}  // namespace foretouch
