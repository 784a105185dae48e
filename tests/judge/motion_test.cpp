// tests/judge/motion_test.cpp: the oracle's motion against fifty digits, and its bounds
// against what the motion does.
#include "judge/motion.h"

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::plain;
using test::Random;

struct Chain {
  std::vector<Joint> joints;
  std::array<Vec3d, 2> points;
  double size = 1.0;
};

double awkwardAngle(Random& random) {
  switch (random.below(8)) {
    case 0: return 0.0;
    case 1: return random.magnitude(1e-14, 1e-3);
    case 2: return 3.14159265358979 - random.magnitude(1e-9, 1e-2);
    default: return random.uniform(0.0, 2.5);
  }
}

Chain drawnChain(int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  Chain chain;
  const int count = 1 + random.below(7);
  for (int j = 0; j < count; ++j) {
    const auto from = random.rotation();
    auto to = from * random.turn(awkwardAngle(random));
    if (random.chance(0.3)) to.coeffs() = -to.coeffs();
    const Eigen::Vector3d start = (j == 0 && random.chance(0.2) ? 1e4 : 0.5) * random.direction();
    const Eigen::Vector3d end = start + (random.chance(0.5) ? 0.3 : 0.0) * random.direction();
    chain.size += start.norm() + 0.3;
    chain.joints.push_back({j - 1, plain(from), plain(to), plain(start), plain(end)});
  }
  chain.points = {plain(random.inBox(0.3)), plain(random.inBox(0.3))};
  return chain;
}

TEST(OracleMotion, AgreesWithFiftyDigits) {
  for (int i = 0; i < 1000; ++i) {
    const Chain chain = drawnChain(i);
    Random random(static_cast<std::uint64_t>(i) + 1'000'000);
    const double t = random.uniform(0.0, 1.0);
    const int link = static_cast<int>(chain.joints.size()) - 1;
    const auto ends = Motion(chain.joints).pointsAt(link, chain.points, t, 0);
    const auto frames = preciseFrames(chain.joints, t);
    for (std::size_t k = 0; k < 2; ++k) {
      const Precise3 truth = frames.back().at(chain.points[k].as<Precise>());
      const Vec3r error = ends[k].position - truth.as<Real>();
      ASSERT_LT(norm(error), 5e-18L * chain.size) << "case " << i;
    }
  }
}

TEST(OracleMotion, BoundsHoldThroughoutTheSpan) {
  int tight = 0;
  for (int i = 0; i < 1000; ++i) {
    const Chain chain = drawnChain(i);
    const Motion motion(chain.joints);
    Random random(static_cast<std::uint64_t>(i) + 2'000'000);
    const int link = motion.numLinks() - 1;
    const Real half = random.magnitude(1e-3, 0.5);
    const Real middle = half + random.uniform(0.0, 1.0) * (1 - 2 * half);
    const auto center = motion.pointsAt(link, chain.points, middle, half);
    Real farthest = 0;
    for (int s = -8; s <= 8; ++s) {
      const Real step = half * s / 8;
      const auto there = motion.pointsAt(link, chain.points, middle + step, 0);
      for (std::size_t k = 0; k < 2; ++k) {
        const Real moved = norm(there[k].position - center[k].position);
        ASSERT_LE(moved, center[k].stray(half) + 1e-15L * chain.size) << "case " << i;
        ASSERT_LE(norm(there[k].velocity), center[k].speed * (1 + 1e-15L)) << "case " << i;
        const Vec3r straight = center[k].position + step * center[k].velocity;
        ASSERT_LE(norm(there[k].position - straight),
                  center[k].acceleration * step * step / 2 + 1e-15L * chain.size)
            << "case " << i;
        farthest = std::max(farthest, moved / std::max<Real>(center[k].stray(half), 1e-30L));
      }
    }
    tight += farthest > 0.2L;
  }
  EXPECT_GT(tight, 600);  // a bound that is far too large would hold as well
}

TEST(OracleMotion, VelocityIsTheDerivative) {
  for (int i = 0; i < 300; ++i) {
    const Chain chain = drawnChain(i);
    const Motion motion(chain.joints);
    const int link = motion.numLinks() - 1;
    constexpr Real kStep = 1e-5L;
    const auto before = motion.pointsAt(link, chain.points, 0.4L - kStep, 0);
    const auto after = motion.pointsAt(link, chain.points, 0.4L + kStep, 0);
    const auto here = motion.pointsAt(link, chain.points, 0.4L, 0);
    const Vec3r slope = (1 / (2 * kStep)) * (after[0].position - before[0].position);
    // The third derivative is at most that of seven joints turning by pi: some 1e4 of their size.
    ASSERT_LT(norm(slope - here[0].velocity), 1e-5L) << "case " << i;
  }
}

TEST(OracleMotion, TakesTheShorterArc) {
  Joint joint;
  joint.toRotation = {-std::cos(0.25), 0, 0, -std::sin(0.25)};  // half a radian about z, other sign
  const auto ends = Motion({joint}).pointsAt(0, {Vec3d{1, 0, 0}, Vec3d{}}, 0.5L, 0);
  EXPECT_NEAR(static_cast<double>(ends[0].position.x), std::cos(0.25), 1e-15);
  EXPECT_NEAR(static_cast<double>(ends[0].position.y), std::sin(0.25), 1e-15);
}

}  // namespace
}  // namespace foretouch::oracle
