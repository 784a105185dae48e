// What an LSS sweeps, held against places on its way; and that fewer triangles are kept than boxes
// keep.
#include "middleware/events/swept_tube.h"

#include <gtest/gtest.h>

#include "articulated/motion.h"
#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/scene/culler.h"
#include "tests/support/random_geometry.h"
#include "tests/support/random_motion.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::Random;

constexpr int kCases = 300, kTriangles = 60, kInstants = 12;

struct TubeTally {
  int near = 0, kept = 0, inBoxes = 0, held = 0, measured = 0, all = 0;
};

Triangle randomTriangle(Random& random, const Vector3d& place) {
  Triangle triangle;
  const double size = random.magnitude(0.005, 0.5);
  for (Vector3d& vertex : triangle.vertices) vertex = place + random.inBox(size);
  if (random.chance(0.1)) triangle.vertices[2] = triangle.vertices[1];
  return triangle;
}

void judge(int i, TubeTally& tally) {
  Random random(static_cast<std::uint64_t>(i));
  const test::RandomMotion moved = test::randomMotion(random, 1 + random.below(4));
  const Vector3d place = random.chance(0.3)
                             ? Vector3d(random.magnitude(1.0, 1e6) * random.direction())
                             : Vector3d::Zero();
  Pose from = moved.from, to = moved.to;
  from.translations[0] += place;
  to.translations[0] += place;
  const ChainMotion motion(moved.skeleton, from, to);
  const LinkId link = random.below(moved.skeleton.numJoints());
  const Lss lss{random.inBox(0.3), random.inBox(0.3), random.chance(0.2) ? 0.0 : 0.05};
  const AxisBounds bounds = axisBounds(lss, motion.bounds(link));
  const double begin = random.uniform(0.0, 0.8);
  const double end = random.chance(0.2) ? begin : random.uniform(begin, 1.0);
  const double margin = random.magnitude(1e-6, 0.02);
  const AxisEnds first = axisEnds(lss, motion.stateAt(link, begin));
  const AxisEnds last = axisEnds(lss, motion.stateAt(link, end));
  const SweptTube tube(lss, bounds, first, last, end - begin, margin);
  const Aabb box = sweptBox(lss, bounds, first, last, end - begin, margin);
  for (int k = 0; k < kTriangles; ++k) {
    const Triangle triangle = randomTriangle(random, 0.5 * (first.a + first.b) + random.inBox(0.2));
    bool isNear = false;
    for (int n = 0; n <= kInstants; ++n) {
      const AxisEnds now =
          axisEnds(lss, motion.stateAt(link, begin + (end - begin) * n / kInstants));
      const Separation apart = separation(Hull::segment(now.a, now.b), Hull::of(triangle));
      isNear = isNear || apart.upper <= lss.radius + margin;
    }
    const bool isKept = tube.mayMeet(triangle);
    EXPECT_TRUE(isKept || !isNear) << "case " << i << ", triangle " << k;
    const bool isMeasured = tube.distanceTo(triangle).has_value();
    EXPECT_TRUE(isMeasured || !isNear) << "case " << i << ", triangle " << k;
    EXPECT_TRUE(isKept || !isMeasured) << "case " << i << ", triangle " << k;
    const bool isInBox = box.overlaps(boxOf(triangle));
    tally.near += isNear ? 1 : 0;
    tally.inBoxes += isInBox ? 1 : 0;
    tally.kept += isInBox && isKept ? 1 : 0;
    tally.measured += isMeasured ? 1 : 0;
    tally.held += isKept ? 1 : 0;
    ++tally.all;
  }
}

TEST(SweptTube, HoldsWhateverComesNearOnTheWay) {
  TubeTally tally;
  for (int i = 0; i < kCases; ++i) judge(i, tally);
  EXPECT_GT(tally.near, tally.all / 20);
  EXPECT_LT(tally.near, tally.all / 2);
  EXPECT_LT(tally.kept, tally.inBoxes * 9 / 10);
  EXPECT_LT(tally.measured, tally.held * 9 / 10);
}

// The ball of a triangle that only just touches the tube is kept, and one that is a little farther
// away is not.
TEST(SweptTube, EndsWhereItsReachDoes) {
  const Lss lss{Vector3d(0, 0, 0), Vector3d(1, 0, 0), 0.1};
  const AxisEnds begin{lss.a, lss.b};
  const AxisEnds end{lss.a + Vector3d(0, 0, 0.02), lss.b + Vector3d(0, 0, 0.04)};
  const SweptTube tube(lss, AxisBounds(), begin, end, 0.5, 0.05);
  const auto point = [](double z) {
    const Vector3d p(0.5, 0, z);
    return Triangle{{p, p, p}};
  };
  // Half-way, the middle of the axis is at 0.015; from there the farther end strays 0.02.
  constexpr double kTop = 0.015 + 0.02 + 0.1 + 0.05;
  EXPECT_TRUE(tube.mayMeet(point(kTop - 1e-3)));
  EXPECT_FALSE(tube.mayMeet(point(kTop + 1e-3)));
}

}  // namespace
}  // namespace foretouch::internal
