// tests/judge/way_judge_test.cpp: the judge of ways against fifty digits, and against lies.
#include "judge/way_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "judge/heights.h"
#include "judge/plain_distance.h"
#include "judge/plain_motion.h"
#include "tests/support/random_motion.h"

namespace foretouch::oracle {
namespace {

using test::Random;
using test::RandomMotion;

PlainPose poseOf(const std::vector<Joint>& joints, bool isTo) {
  PlainPose pose;
  for (const Joint& joint : joints) {
    pose.rotations.push_back(isTo ? joint.toRotation : joint.fromRotation);
    pose.translations.push_back(isTo ? joint.toTranslation : joint.fromTranslation);
  }
  return pose;
}

struct Case {
  std::vector<Joint> joints;
  WayBody body;
  std::vector<Triangle> triangles;
};

Case randomCase(Random& random) {
  Case one;
  RandomMotion steps = test::randomMotion(random, 2 + random.below(6));
  one.joints = steps.precise;
  // The far origins of random motions are for errors relative to them; here near ones do.
  one.joints[0].toTranslation = one.joints[0].toTranslation - one.joints[0].fromTranslation;
  one.joints[0].fromTranslation = {};
  for (const Joint& joint : one.joints) {
    one.body.parents.push_back(joint.parent);
    const auto point = [&] { return Vec3d(random.inBox(0.2)); };
    one.body.capsules.push_back({{{point(), point()}, random.uniform(0.0, 0.1)}});
  }
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d at = random.inBox(1.0);
    const auto corner = [&] { return Vec3d(Eigen::Vector3d(at + random.inBox(0.4))); };
    one.triangles.push_back({corner(), corner(), corner()});
  }
  return one;
}

/// The least over `instants` instants, in fifty digits.
double preciseLeast(const Case& one, int instants) {
  double least = Box::kEmpty;
  for (int i = 0; i < instants; ++i) {
    const auto frames = preciseFrames(one.joints, Precise(i) / Precise(instants - 1));
    for (std::size_t link = 0; link < frames.size(); ++link) {
      const Capsule& capsule = one.body.capsules[link][0];
      const auto a = frames[link].at(Precise3(capsule.ends[0].as<Precise>()));
      const auto b = frames[link].at(Precise3(capsule.ends[1].as<Precise>()));
      const Vec3d from(static_cast<double>(a.x), static_cast<double>(a.y),
                       static_cast<double>(a.z));
      const Vec3d to(static_cast<double>(b.x), static_cast<double>(b.y), static_cast<double>(b.z));
      for (const Triangle& triangle : one.triangles) {
        least = std::min(least, closestPoints(from, to, triangle).distance - capsule.radius);
      }
    }
  }
  return least;
}

TEST(WayJudge, FindsTheLeastSeparationOfFiftyDigits) {
  constexpr int kInstants = 17;
  WayLooks looks;
  looks.instants = kInstants;
  looks.spacing = 1e9;
  int inside = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const Case one = randomCase(random);
    const Scene scene(one.triangles);
    WayJudge judge(scene, one.body);
    const double least = preciseLeast(one, kInstants);
    const WayReading reading =
        judge.along(poseOf(one.joints, false), poseOf(one.joints, true), 1e6, looks);
    EXPECT_NEAR(reading.least, least, 1e-11) << seed;
    EXPECT_EQ(reading.instants, kInstants);
    inside += least <= 0.0;
    // A cutoff below it finds nothing; one above it, the same.
    const double nearer = least - 1e-9;
    const WayReading none =
        judge.along(poseOf(one.joints, false), poseOf(one.joints, true), nearer, looks);
    EXPECT_EQ(none.link, -1) << seed;
    EXPECT_EQ(none.least, nearer);
    const WayReading same =
        judge.along(poseOf(one.joints, false), poseOf(one.joints, true), least + 1e-9, looks);
    EXPECT_EQ(same.least, reading.least) << seed;
    EXPECT_EQ(same.triangle, reading.triangle) << seed;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, 55);
}

TEST(WayJudge, AsksItsLastNearestFirstAndAnswersTheSame) {
  // One judge over many ways, each of which starts from what was nearest on the one before.
  Random random(7);
  const Case one = randomCase(random);
  const Scene scene(one.triangles);
  WayJudge used(scene, one.body);
  int other = 0, outside = 0, last = -1;
  for (int i = 0; i < 200; ++i) {
    PlainPose from = poseOf(one.joints, i % 2 == 0), to = poseOf(one.joints, i % 3 == 0);
    from.translations[0] = Vec3d(random.inBox(1.0));
    to.translations[0] = Vec3d(random.inBox(1.0));
    const WayReading reading = used.along(from, to, 5.0);
    const WayReading fresh = WayJudge(scene, one.body).along(from, to, 5.0);
    EXPECT_EQ(reading.least, fresh.least) << i;
    // An axis that pierces a triangle is inside by its radius, wherever it does.
    if (reading.least > 0.0) {
      EXPECT_EQ(reading.t, fresh.t) << i;
      EXPECT_EQ(reading.triangle, fresh.triangle) << i;
      EXPECT_EQ(reading.link, fresh.link) << i;
      ++outside;
    }
    other += std::exchange(last, reading.triangle) != reading.triangle;
  }
  EXPECT_GT(other, 50);
  EXPECT_GT(outside, 20);
}

/// A ball of 3 cm that a root carries over 2 m along x.
WayBody ball() {
  WayBody body;
  body.parents = {-1};
  body.capsules = {{{{Vec3d(0, 0, 0), Vec3d(0, 0, 0)}, 0.03}}};
  return body;
}
PlainPose ballAt(double x) {
  return {{{1, 0, 0, 0}}, {Vec3d(x, 0, 0)}};
}

TEST(WayJudge, SeesWhatIsPassedBetweenTwoOfTheLeastInstants) {
  // A sheet of 1 cm, edge on to fifty instants over 20 m: they are 40 cm apart.
  const Scene scene({Triangle{Vec3d(7.55, -1, -1), Vec3d(7.55, 1, -1), Vec3d(7.55, 0, 1)}});
  WayJudge judge(scene, ball());
  const WayReading reading = judge.along(ballAt(0.0), ballAt(20.0), 0.02);
  EXPECT_LT(reading.least, -0.02);
  EXPECT_EQ(reading.triangle, 0);
  EXPECT_GT(reading.instants, 2000u);
  WayLooks blind;
  blind.spacing = 1e9;
  EXPECT_GT(judge.along(ballAt(0.0), ballAt(20.0), 0.02, blind).least, 0.0);
}

TEST(WayJudge, MeasuresOwnLinksFromEachOther) {
  const Scene scene({Triangle{Vec3d(50, 0, 0), Vec3d(51, 0, 0), Vec3d(50, 1, 0)}});
  WayBody body;
  body.parents = {-1, -1};
  body.capsules = {{{{Vec3d(0, -1, 0), Vec3d(0, 1, 0)}, 0.1}},
                   {{{Vec3d(0, 0, -1), Vec3d(0, 0, 1)}, 0.2}}};
  const PlainPose from{{{1, 0, 0, 0}, {1, 0, 0, 0}}, {Vec3d(-1, 0, 0), Vec3d(1, 0, 0)}};
  const PlainPose to{{{1, 0, 0, 0}, {1, 0, 0, 0}}, {Vec3d(-1, 0, 0), Vec3d(-0.5, 0, 0)}};
  EXPECT_EQ(WayJudge(scene, body).along(from, to, 5.0).link, -1);
  body.ownPairs = {{0, 1}};
  const WayReading reading = WayJudge(scene, body).along(from, to, 5.0);
  EXPECT_NEAR(reading.least, 0.2, 1e-12);
  EXPECT_EQ(reading.link, 0);
  EXPECT_EQ(reading.other, 1);
  EXPECT_NEAR(WayJudge(scene, body).at(from, 5.0).least, 1.7, 1e-12);
}

TEST(WayJudge, TakesTheShorterArc) {
  // Minus the same turn is the same place: nothing moves.
  const Scene scene({Triangle{Vec3d(1, -1, -1), Vec3d(1, 1, -1), Vec3d(1, 0, 1)}});
  WayBody body = ball();
  body.capsules[0][0].ends = {Vec3d(0, 0, 0), Vec3d(0, 1.2, 0)};
  const PlainPose from = ballAt(0.0);
  PlainPose to = from;
  to.rotations[0] = {-1, 0, 0, 0};
  EXPECT_EQ(WayJudge(scene, body).along(from, to, 0.5).link, -1);
  to.rotations[0] = {std::sqrt(0.5), 0, 0, -std::sqrt(0.5)};  // a quarter, towards the sheet
  EXPECT_LT(WayJudge(scene, body).along(from, to, 0.5).least, 0.0);
}

TEST(Heights, AreThoseOfEverySheetAboveAPlace) {
  const auto sheet = [](double y) {
    return Triangle{Vec3d(0, y, 0), Vec3d(1, y, 0), Vec3d(0, y + 1, 1)};
  };
  const Scene scene(
      {sheet(2.0), sheet(-1.0), Triangle{Vec3d(0, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)}});
  EXPECT_EQ(heightsAt(scene, 0.25, 0.5), (std::vector<double>{-0.5, 2.5}));
  EXPECT_TRUE(heightsAt(scene, 0.9, 0.9).empty());
}

}  // namespace
}  // namespace foretouch::oracle
