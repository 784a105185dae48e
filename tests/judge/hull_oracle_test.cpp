// tests/judge/hull_oracle_test.cpp: the oracle of the extremes: its distances and motions against
// other formulas and more digits, and the whole against planted lies.
#include "judge/hull_oracle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "judge/plain_motion.h"
#include "judge/wide.h"
#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

Vec3d inBox(Random& random) {
  return Vec3d(random.inBox(1.0));
}
std::array<double, 4> numbersOf(const Eigen::Quaternion<double, Eigen::DontAlign>& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

/// Three points of which some coincide, lie on a line or next to one.
Triangle hostile(Random& random) {
  Triangle v{inBox(random), inBox(random), inBox(random)};
  switch (random.below(6)) {
    case 0: v[1] = v[0]; break;
    case 1: v[1] = v[2] = v[0]; break;
    case 2: v[2] = 0.5 * (v[0] + v[1]); break;
    case 3: v[2] = 0.5 * (v[0] + v[1]) + 1e-12 * Vec3d(random.direction()); break;
    default: break;
  }
  return v;
}

TEST(PlainDistance, IsThatOfOtherFormulasAndMoreDigits) {
  for (int i = 0; i < 400; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Triangle one = hostile(random), other = hostile(random);
    const auto wideOne = cornersOf<Wide>(one), wideOther = cornersOf<Wide>(other);
    for (const int count : {2, 3}) {
      const Precise own =
          sqrt(nearestPoints(cornersOf<Precise>(one), count, cornersOf<Precise>(other)).square);
      const VeryPrecise more = sqrt(
          nearestPoints(cornersOf<VeryPrecise>(one), count, cornersOf<VeryPrecise>(other)).square);
      const Wide expected = count == 2 ? closestPoints(wideOne[0], wideOne[1], wideOther).distance
                                       : closestPoints(wideOne, wideOther).distance;
      // What long double leaves of thirty-four digits holds the rest.
      const auto high = static_cast<Real>(expected);
      const auto low = static_cast<Real>(expected - Wide(high));
      ASSERT_LT(abs(own - (Precise(high) + Precise(low))), 1e-30) << i;
      ASSERT_LT(abs(own.widened() - more), 1e-30) << i;
    }
  }
}

TEST(PlainDistance, OfWhatMeetsIsZeroExactly) {
  int meeting = 0;
  for (int i = 0; i < 1000; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const Triangle one = hostile(random), other = hostile(random);
    const Precise distance = preciseDistance(cornersOf<Precise>(one), cornersOf<Precise>(other));
    EXPECT_TRUE(distance == 0 || distance > 1e-20) << i;
    meeting += distance == 0 ? 1 : 0;
  }
  EXPECT_GT(meeting, 20);
  EXPECT_LT(meeting, 500);
}

TEST(PreciseMotion, IsThatOfSlerpBySineWeights) {
  for (int i = 0; i < 40; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    std::vector<Joint> joints;
    for (int j = 0; j < 4; ++j) {
      constexpr std::array<double, 4> kAngles{1.0, 3.1, 1e-12, 1e-5};
      const auto from = random.turn(random.uniform(0.0, 3.0));
      const auto to = from * random.turn(kAngles[static_cast<std::size_t>(random.below(4))]);
      joints.push_back({j - 1, numbersOf(from), numbersOf(to), inBox(random), inBox(random)});
    }
    const Precise t = random.uniform(0.0, 1.0);
    std::vector<MovingFrame<Precise>> frames;
    MotionOf<Precise>(joints).framesAt(t, frames);
    const Vec3d p_L = inBox(random);
    const Precise3 x = frames.back().at(p_L.as<Precise>());
    const Precise3 y = preciseFrames(joints, t).back().at(p_L.as<Precise>());
    EXPECT_LT(norm(x - y), 1e-20) << i;
    const auto carried = MotionOf<Precise>(joints).pointsAt<1>(3, {p_L}, t, 0)[0];
    EXPECT_LT(norm(x - carried.position), 1e-45) << i;
    EXPECT_LT(norm(frames.back().velocityAt(x) - carried.velocity), 1e-45) << i;
  }
}

// An arc that is handed in is taken, whatever the signs of the quaternions say.
TEST(PreciseMotion, TakesTheArcItIsTold) {
  Joint joint;
  joint.toRotation = {-std::cos(0.25), 0, 0, -std::sin(0.25)};  // half a radian about z, other sign
  const auto end = [&] { return Motion({joint}).pointsAt<1>(0, {Vec3d{1, 0, 0}}, 0.5L, 0)[0]; };
  EXPECT_NEAR(static_cast<double>(end().position.y), std::sin(0.25), 1e-15);
  joint.isFlipped = false;
  EXPECT_NEAR(static_cast<double>(end().position.y), -std::sin(0.25), 1e-15);
}

/// A ball of radius 1/4 falls from 1 to 0 above the floor: it touches at 3/4.
HullWorld fallingBall() {
  HullWorld world;
  Joint joint;
  joint.fromTranslation = {0.0, 1.0, 0.0};
  world.joints = {joint};
  world.hulls = {{0, 2, {}, 0.25}};
  world.triangles = {{Vec3d{-50, 0, -50}, Vec3d{150, 0, -50}, Vec3d{-50, 0, 150}}};
  return world;
}

TEST(HullOracle, CatchesPlantedLies) {
  const HullOracle oracle(fallingBall());
  EXPECT_LT(abs(oracle.separationAt(0, 0.0) - Precise(0.75)), 1e-45);
  EXPECT_LT(abs(oracle.separationAt(0, 0.75)), 1e-45);
  const double before = 0.75 - 1e-9, after = std::nextafter(0.75, 1.0);
  EXPECT_EQ(oracle.proveFree({before}).front().freedom, Freedom::Proven);
  EXPECT_LT(oracle.proveFree({before}).front().least, 0.1);
  for (const double lie : {0.75 + 1e-9, 0.9, 1.0}) {
    const FreedomProof proof = oracle.proveFree({lie}).front();
    EXPECT_EQ(proof.freedom, Freedom::Touches) << lie;
    EXPECT_LT(proof.touchesAt, lie);
    EXPECT_GE(proof.touchesAt, 0.75);
  }
  EXPECT_NE(oracle.proveFree({after}).front().freedom, Freedom::Proven);
}

TEST(HullOracle, SeesWhatIsCrossedWithinOneStep) {
  HullWorld world = fallingBall();
  world.joints[0].fromTranslation = {0.0, 1e5, 0.0};
  world.joints[0].toTranslation = {0.0, -1e5, 0.0};
  const FreedomProof proof = HullOracle(world).proveFree({1.0}).front();
  EXPECT_EQ(proof.freedom, Freedom::Touches);
  world.triangles[0][0][0] = world.triangles[0][1][0] = world.triangles[0][2][0] = 1.0;
  EXPECT_EQ(HullOracle(world).proveFree({1.0}).front().freedom, Freedom::Proven);
}

TEST(HullOracle, ComparesFallsWithoutRounding) {
  EXPECT_FALSE(isAfterFall(0.75, 1.0, 0.0, 0.25));
  EXPECT_TRUE(isAfterFall(std::nextafter(0.75, 1.0), 1.0, 0.0, 0.25));
  EXPECT_FALSE(isAfterFall(1.0, 1.0, 0.0, 0.0));
  EXPECT_TRUE(isAfterFall(1.0, 1.0, 0.0, 5e-324));
  EXPECT_FALSE(isAfterFall(std::nextafter(1.0, 0.0), 1.0, 0.0, 5e-324));
}

}  // namespace
}  // namespace foretouch::oracle
