// Props of triangles that spin past bodies: as links that are carried through time, and as frames
// that the bodies are seen from. Both ways, and the judge's own world, give the same answers.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "lss/separation.h"
#include "middleware/world/world_parts.h"
#include "tests/middleware/own_body.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// A ring about z, through which limbs fit.
Scene ring(Random& random) {
  constexpr double kTurn = 6.283185307179586;
  constexpr int kAround = 12, kAcross = 4;
  const double radius = random.uniform(0.1, 0.3), thick = random.uniform(0.01, 0.04);
  const auto at = [&](int i, int j) {
    const double u = kTurn * i / kAround, v = kTurn * j / kAcross;
    const double out = radius + thick * std::cos(v);
    return Vector3d(out * std::cos(u), out * std::sin(u), thick * std::sin(v));
  };
  RawScene raw;
  raw.objectNames = {"ring"};
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAcross; ++j) {
      raw.triangles.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1)}});
      raw.triangles.push_back({{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    }
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

/// Up to 2.5 radians from pose to pose, and so always above what a frame may turn.
void spin(BothWorlds& both, BodyId body, std::int64_t periodUs, Random& random) {
  RigidPose pose{random.rotation(), random.inBox(0.5)};
  const Vector3d drift = random.inBox(0.3);
  const Quaternion turn = random.turn(random.uniform(0.3, 2.5));
  for (std::int64_t us = 0; us < kWindowUs + periodUs; us += periodUs) {
    both.push(body, us, pose);
    pose.translation += drift;
    pose.rotation = (pose.rotation * turn).normalized();
  }
}

TEST(WorldSpin, IsProvenByTheJudge) {
  WorldTally sum;
  for (int i = 0; i < 80; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(11'000 + i));
    BothWorlds both(randomTolerance(random));
    const Scene thing = ring(random);
    const bool isFirst = random.chance(0.5);
    Walker walker = randomWalker(random, random.inBox(0.3), 0.1);
    const BodyId one = isFirst ? both.add(thing) : both.add(walker.avatar);
    const BodyId other = isFirst ? both.add(walker.avatar) : both.add(thing);
    walk(both, isFirst ? other : one, walker, randomPeriod(random), kWindowUs, random);
    spin(both, isFirst ? one : other, randomPeriod(random), random);
    both.judgeAll(random.below(20'000), kWindowUs);
    add(both, sum);
    for (const WorldContact& contact : both.answer.contacts) {
      const ContactSide& side = isFirst ? contact.a : contact.b;
      EXPECT_EQ(side.lss, -1);
      EXPECT_GE(side.triangle, 0);
      EXPECT_EQ((isFirst ? contact.b : contact.a).triangle, -1);
    }
  }
  EXPECT_GT(sum.clear, 30);
  EXPECT_GT(sum.contact, 12);
  EXPECT_GT(sum.start, 5);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

// A tool that is swung meets the arm that holds it and another body.
TEST(WorldSpin, IsProvenOfToolsInHands) {
  WorldTally sum;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(12'000 + i));
    BothWorlds both(randomTolerance(random));
    for (int k = 0; k < 2; ++k) {
      Walker walker = randomWalker(random, random.inBox(0.4), 0.05);
      for (Quaternion& turn : walker.turns) turn = random.turn(random.uniform(0.3, 0.8));
      walk(both, both.add(walker.avatar), walker, 33'333, kWindowUs, random);
    }
    const BodyId tool = both.add(ring(random));
    const LinkId hand = random.below(both.world.parts().kindOf(0).skeleton.numJoints());
    both.attach(tool, {0, hand}, 0, RigidPose{random.rotation(), random.inBox(0.3)});
    both.judgeAll(0, kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 100);
  EXPECT_GT(sum.contact, 20);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

/// How deep the deepest of the ring's triangles is in the link, one after the other.
double deepestIn(const Walker& walker, LinkId link, const Scene& ring, const RigidPose& at) {
  const ChainMotion still(walker.avatar.skeleton(), walker.pose, walker.pose);
  const LinkState state = still.stateAt(link, 0.0);
  double deepest = 0.0;
  for (const Lss& lss : walker.avatar.lss(link)) {
    const Hull axis = Hull::segment(state.pointAt(lss.a), state.pointAt(lss.b));
    for (std::size_t i = 0; i < ring.numTriangles(); ++i) {
      Triangle triangle = ring.triangle(static_cast<TriangleId>(i));
      for (Vector3d& v : triangle.vertices) v = at.rotation * v + at.translation;
      deepest = std::max(deepest, lss.radius - separation(axis, Hull::of(triangle)).distance);
    }
  }
  return deepest;
}

// Whoever cuts into a ring touches many of its triangles at once: the deepest is told, whichever
// way it is found.
TEST(WorldSpin, TellsTheDeepestTriangleAtTheStart) {
  int starts = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(13'000 + i));
    const Scene thing = ring(random);
    Walker walker = randomWalker(random, random.inBox(0.2), 0.0);
    const RigidPose begin{random.rotation(), random.inBox(0.2)};
    const Quaternion half = random.turn(1.0), little = random.turn(1e-3);
    std::vector<WorldContacts> answers;
    for (const Quaternion& turn : {half, little}) {
      BothWorlds both(1e-5);
      both.add(walker.avatar);
      both.add(thing);
      for (const std::int64_t us : {std::int64_t{0}, kWindowUs}) {
        both.push(0, us, walker.pose);
        both.push(1, us, us == 0 ? begin : RigidPose{begin.rotation * turn, begin.translation});
      }
      both.judgeAll(0, kWindowUs);
      for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
      answers.push_back(both.answer);
    }
    const auto isStart = [](const WorldContact& c) {
      return c.verdict == Verdict::StartsInContact;
    };
    for (const WorldContact& spun : answers[0].contacts) {
      if (!isStart(spun)) continue;
      const auto seen = std::find_if(
          answers[1].contacts.begin(), answers[1].contacts.end(),
          [&](const WorldContact& c) { return c.a.link == spun.a.link && isStart(c); });
      ASSERT_NE(seen, answers[1].contacts.end());
      EXPECT_NEAR(spun.penetration, seen->penetration, 1e-9);
      EXPECT_NEAR(spun.penetration, deepestIn(walker, spun.a.link, thing, begin), 1e-9);
      ++starts;
    }
  }
  EXPECT_GT(starts, 30);
}

// A prop is known by a box alone until it may meet somebody: the box must hold it however it turns.
TEST(WorldSpin, IsNotLostWhereOnlyABoxIsKnown) {
  WorldTally sum;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(14'000 + i));
    BothWorlds both(randomTolerance(random));
    const Vector3d place =
        random.chance(0.3) ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    const Lss rod{random.inBox(0.4), random.inBox(0.4), 0.02};
    RawSkeleton one;
    one.joints = {{"rod", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
    const Avatar stick = Avatar::build(Skeleton::build(one).value(), {{rod}}).value();
    for (int k = 0; k < 4; ++k) {
      const BodyId body = k % 2 == 0 ? both.add(stick) : both.add(ring(random));
      fly(both, body, place + random.inBox(0.8), randomPeriod(random), kWindowUs, random);
    }
    for (BodyId a = 0; a < 4; ++a) {
      for (BodyId b = a + 1; b < 4; ++b) {
        if (a % 2 == 1 && b % 2 == 1) continue;  // two meshes are not asked
        both.judge(a, b, 0, kWindowUs);
      }
    }
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 100);
  EXPECT_GT(sum.contact, 17);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 10);
}

// Two rods whose tips meet when both point at each other, in the middle of their turn: the boxes
// are just large enough.
TEST(WorldSpin, MeetsByTheTipsOfWhatTurns) {
  constexpr double kLength = 0.7, kRadius = 0.01, kTolerance = 1e-4;
  const Lss rod{Vector3d::Zero(), Vector3d(kLength, 0, 0), kRadius};
  RawSkeleton one;
  one.joints = {{"rod", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Avatar stick = Avatar::build(Skeleton::build(one).value(), {{rod}}).value();
  for (const Vector3d& place : {Vector3d(0, 0, 0), Vector3d(-3e3, 40, 7e3)}) {
    for (const double gap : {-1e-3, 2e-3}) {
      BothWorlds both(kTolerance);
      for (int body = 0; body < 2; ++body) {
        both.add(stick);
        const double side = body == 0 ? 0.0 : 1.0;
        const Vector3d at = place + Vector3d(side * (2.0 * (kLength + kRadius) + gap), 0, 0);
        for (const double turn : {-0.4, 0.4}) {
          const Eigen::AngleAxisd about(turn + side * std::acos(-1.0), Vector3d::UnitZ());
          both.push(body, turn < 0.0 ? 0 : 100'000, {Quaternion(about), at});
        }
      }
      both.judgeAll(0, 100'000);
      for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
      ASSERT_EQ(both.tally.contact, gap < 0.0 ? 1 : 0);
      EXPECT_EQ(both.answer.counters.bodies, 2u);
    }
  }
}

}  // namespace
}  // namespace foretouch::test
