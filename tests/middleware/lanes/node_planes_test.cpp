// Planes at the nodes: what they close is apart between the nodes, at every width; they close
// nearly all that is clearly apart; and what carries the whole body does not open anything.
#include "middleware/lanes/node_planes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "judge/motion.h"
#include "lss/simd.h"
#include "middleware/lanes/pair_boxes.h"
#include "tests/support/widest_afterwards.h"
#include "tests/tessellation/random_lss.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::NodeRange;
using internal::PlanePair;
using oracle::Real;
using oracle::Vec3d;
using oracle::Vec3r;
using test::Random;

/// A moving body's pairs of LSS, as a query makes them: planes rest in the frame of the root.
struct Planes {
  Planes(const LssTable& aTable, const ChainMotion& motion, double floor) : table(aTable) {
    nodes.evaluate(motion, 0.0, 1.0, Vector3d::Zero());
    sweptBoxes(table, motion, nodes, 0.0, boxes, &ends);
    for (std::size_t k = 0; k < 9; ++k) {
      for (std::size_t node = 0; node < kNodes; ++node) {
        frame.R[k][node] = static_cast<float>(nodes.link(0).R[k][node]);
      }
    }
    for (std::int32_t i = 0; i < table.size(); ++i) {
      for (std::int32_t j = i + 1; j < table.size(); ++j) add(i, j, motion, floor);
    }
  }

  void add(std::int32_t i, std::int32_t j, const ChainMotion& motion, double floor) {
    const auto bendOf = [&](std::int32_t k) {
      return motion.sumsIn(0, table[k].link).accelerationAt(std::max(table[k].rhoA, table[k].rhoB));
    };
    const auto x = static_cast<std::size_t>(i), y = static_cast<std::size_t>(j);
    const double reach =
        table[i].radius + table[j].radius + floor +
        internal::kNodePlaneRounding * (double{ends.extents[x]} + double{ends.extents[y]}) +
        double{ends.roundings[x]} + double{ends.roundings[y]};
    pairs.push_back({i, j, 0, static_cast<float>(reach * (1.0 + 0x1p-20)),
                     static_cast<float>((bendOf(i) + bendOf(j)) * (1.0 + 0x1p-20))});
  }

  void close() {
    internal::NodePlanes planes{ends.axes.data(), &frame, {}};
    for (int k = 0; k < internal::kNodePieces; ++k) {
      const double h = nodes.instant(k + 1) - nodes.instant(k);
      planes.sagittas[k] = static_cast<float>(h * h / 8.0 * (1.0 + 0x1p-20));
    }
    for (const int node : {3, 0, 7}) {
      internal::closeByPlanes(planes, node, pairs.data(), pairs.size());
    }
  }

  /// The second of each pair is seen from another origin, which is `away`.
  void closeAtRest(const ChainMotion& motion, const Vector3d& away, const NodeRange& of = {},
                   const NodeRange& ofOther = {}) {
    ChainNodes nodesOfOther;
    NodeEnds others;
    nodesOfOther.evaluate(motion, 0.0, 1.0, away);
    sweptBoxes(table, motion, nodesOfOther, 0.0, boxes, &others);
    internal::NodePlanes planes{ends.axes.data(), &frame, {}};
    planes.others = others.axes.data();
    double shifted = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double shift = away[k] + others.origin[k] - ends.origin[k];
      planes.shift[k] = static_cast<float>(shift);
      shifted += internal::kNodePlaneRounding * std::abs(shift);
    }
    const double gap = widestGap(nodes);
    for (PlanePair& pair : pairs) {
      const auto bendOf = [&](std::int32_t k) {
        return motion.sums(table[k].link).accelerationAt(std::max(table[k].rhoA, table[k].rhoB));
      };
      const auto y = static_cast<std::size_t>(pair.j);
      pair.reach += static_cast<float>(
          (shifted + (bendOf(pair.i) + bendOf(pair.j)) * gap * gap / 8.0 +
           internal::kNodePlaneRounding * double{others.extents[y]} + double{others.roundings[y]}) *
          (1.0 + 0x1p-20));
    }
    planes.nodes = of;
    planes.otherNodes = ofOther;
    for (const auto& [node, other] :
         {std::pair{(of.first + of.last) / 2, ofOther.first}, std::pair{of.first, ofOther.last},
          std::pair{of.last, ofOther.first}}) {
      internal::closeByRestingPlanes(planes, node, other, pairs.data(), pairs.size());
    }
  }

  const LssTable& table;
  ChainNodes nodes;
  SweptBoxes boxes;
  NodeEnds ends;
  internal::NodeFrame frame{};
  std::vector<PlanePair> pairs;
};

/// Of two LSS, each at an instant, in long double.
Real separationAt(const oracle::Motion& truth, const LssTable& table, const PlanePair& pair, Real t,
                  Real tOfOther) {
  const auto axisAt = [&](std::int32_t i, Real at) {
    const std::array<Vec3d, 2> ends = {Vec3d(table[i].a[0], table[i].a[1], table[i].a[2]),
                                       Vec3d(table[i].b[0], table[i].b[1], table[i].b[2])};
    return truth.pointsAt(table[i].link, ends, at, Real(0));
  };
  const auto one = axisAt(pair.i, t), other = axisAt(pair.j, tOfOther);
  const oracle::Corners<Real> segment = {other[0].position, other[1].position, other[1].position};
  return oracle::closestPoints(one[0].position, one[1].position, segment).distance -
         (Real(table[pair.i].radius) + Real(table[pair.j].radius));
}

TEST(NodePlanes, CloseOnlyWhatIsApartAtEveryWidth) {
  const test::WidestAfterwards guard;
  int closed = 0, open = 0, wide = 0, closedOfWide = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 3 + random.below(5));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const oracle::Motion truth(body.motion.precise);
    const double floor = random.magnitude(1e-6, 1e-2);
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      Planes planes(table, motion, floor);
      planes.close();
      for (const PlanePair& pair : planes.pairs) {
        for (int piece = 0; piece < internal::kNodePieces; ++piece) {
          const bool isOpen = (pair.open >> piece & 1) != 0;
          (isOpen ? open : closed) += 1;
          const double first = planes.nodes.instant(piece);
          const double share = random.uniform(0.0, 1.0);
          const Real t = Real(first) + Real(share) * (planes.nodes.instant(piece + 1) - first);
          const Real apart = separationAt(truth, table, pair, t, t);
          if (!isOpen) {
            ASSERT_GE(apart, Real(floor) - Real(1e-12));
          }
          const double sagitta = double{pair.bend} * 0.0125;
          if (apart > Real(0.3 + sagitta)) {
            ++wide;
            closedOfWide += isOpen ? 0 : 1;
          }
        }
      }
    }
  }
  EXPECT_GT(closed, 10000);
  EXPECT_GT(open, 10000);
  EXPECT_GT(closedOfWide, wide * 6 / 10) << "planes that close nothing prove nothing";
}

NodeRange randomRange(Random& random) {
  const int first = random.below(kNodes - 1);
  return {first, first + 1 + random.below(kNodes - 1 - first)};
}

/// How many more pairs these planes close than those of the whole way.
int closedMore(const Planes& part, const LssTable& table, const ChainMotion& motion, double floor,
               const Vector3d& away) {
  Planes whole(table, motion, floor);
  whole.closeAtRest(motion, away);
  int more = 0;
  for (std::size_t k = 0; k < part.pairs.size(); ++k) {
    more += part.pairs[k].open == 0 && whole.pairs[k].open != 0 ? 1 : 0;
  }
  return more;
}

// A plane at rest keeps two apart wherever each is on its way: at instants of its own, and seen
// from an origin of its own.
TEST(NodePlanes, AtRestCloseOnlyWhatIsApartAtAnyTwoInstantsAtEveryWidth) {
  const test::WidestAfterwards guard;
  int closed = 0, wide = 0, closedOfWide = 0, closedInRanges = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 3 + random.below(5));
    const ChainMotion motion(body.avatar.skeleton(), body.motion.from, body.motion.to);
    const LssTable table(body.avatar);
    const oracle::Motion truth(body.motion.precise);
    const double floor = random.magnitude(1e-6, 1e-2);
    // Half the time each is looked at between two of its nodes alone.
    const bool isPart = random.chance(0.5);
    const NodeRange of = isPart ? randomRange(random) : NodeRange();
    const NodeRange ofOther = isPart ? randomRange(random) : NodeRange();
    const Vector3d away = random.magnitude(1e-3, 30.0) * random.direction();
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      Planes planes(table, motion, floor);
      planes.closeAtRest(motion, away, of, ofOther);
      if (isPart) closedInRanges += closedMore(planes, table, motion, floor, away);
      for (const PlanePair& pair : planes.pairs) {
        Real least = 1e9L;
        for (int sample = 0; sample < 6; ++sample) {
          const Real t = random.uniform(ChainNodes::time(of.first), ChainNodes::time(of.last));
          const Real other =
              random.uniform(ChainNodes::time(ofOther.first), ChainNodes::time(ofOther.last));
          least = std::min(least, separationAt(truth, table, pair, t, other));
        }
        closed += pair.open == 0 ? 1 : 0;
        if (pair.open == 0) {
          ASSERT_GE(least, Real(floor) - Real(1e-12));
        }
        if (least > 1.0L) {
          ++wide;
          closedOfWide += pair.open == 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(closed, 500);
  EXPECT_GT(closedOfWide, wide / 4) << "planes that close nothing prove nothing";
  EXPECT_GT(closedInRanges, 100) << "a part of the way is no easier than all of it";
}

// The planes rest in the root's frame, so turning and moving the root changes no more than
// rounding.
TEST(NodePlanes, AreNotOpenedByWhatCarriesTheBody) {
  int pieces = 0, different = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const test::MovingBody body(random, 4);
    Pose still = body.motion.from, to = body.motion.to, turned = body.motion.to;
    still.translations[0] = to.translations[0] = Vector3d(1, 2, 3);
    turned.translations[0] = Vector3d(2, 2, 3);
    to.rotations[0] = still.rotations[0];
    turned.rotations[0] = still.rotations[0] * random.turn(2.0);
    const LssTable table(body.avatar);
    Planes resting(table, ChainMotion(body.avatar.skeleton(), still, to), 1e-3);
    Planes carried(table, ChainMotion(body.avatar.skeleton(), still, turned), 1e-3);
    resting.close();
    carried.close();
    for (std::size_t k = 0; k < resting.pairs.size(); ++k) {
      EXPECT_NEAR(double{resting.pairs[k].bend}, double{carried.pairs[k].bend},
                  1e-5 * double{resting.pairs[k].bend});
      pieces += internal::kNodePieces;
      different += __builtin_popcount(resting.pairs[k].open ^ carried.pairs[k].open);
    }
  }
  EXPECT_GT(pieces, 3000);
  EXPECT_LT(different, pieces / 50);
}

TEST(PairBoxes, FindEveryAskedPairWhoseBoxesMeetAtEveryWidth) {
  const test::WidestAfterwards guard;
  std::size_t found = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const int count = 1 + random.below(70);
    SweptBoxes boxes;
    boxes.resize(count);
    for (int k = 0; k < count; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<float>(random.uniform(-1.0, 1.0));
        boxes.lower[axis][k] = low;
        boxes.upper[axis][k] =
            random.chance(0.2) ? low : low + static_cast<float>(random.uniform(0.0, 1.2));
      }
    }
    internal::AskedPairs asked;
    asked.blocks = (count + 15) / 16;
    asked.bits.assign(static_cast<std::size_t>(count * asked.blocks), 0);
    std::vector<std::pair<int, int>> expected;
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        if (random.chance(0.3)) continue;
        std::uint16_t& bits = asked.bits[static_cast<std::size_t>(a * asked.blocks + b / 16)];
        bits = static_cast<std::uint16_t>(bits | 1U << (b % 16));
        ++asked.numPairs;
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis) {
          meets = meets && boxes.lower[axis][a] <= boxes.upper[axis][b] &&
                  boxes.lower[axis][b] <= boxes.upper[axis][a];
        }
        if (meets) expected.emplace_back(a, b);
      }
    }
    for (const Simd simd : supportedSimd()) {
      SCOPED_TRACE(toString(simd));
      ASSERT_TRUE(useSimd(simd));
      internal::MeetingPairs meeting;
      internal::collectMeeting(boxes, asked, meeting);
      ASSERT_EQ(meeting.count, expected.size());
      for (std::size_t k = 0; k < meeting.count; ++k) {
        EXPECT_EQ(std::make_pair(meeting.pairs[k].i, meeting.pairs[k].j), expected[k]);
      }
      found += meeting.count;
    }
  }
  EXPECT_GT(found, 1000U);
}

}  // namespace
}  // namespace foretouch
