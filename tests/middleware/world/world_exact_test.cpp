// Random worlds of bodies that touch by their triangles, each answer held against the judge's own
// world, and against the query of one mesh as it is seen from the other.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/own_body.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

/// Asks own links by half, and brings a surface mostly.
BodyOptions exactOptions(const Avatar& avatar, Random& random, double share) {
  BodyOptions options;
  if (random.chance(share)) options.surface = randomSurface(avatar, random);
  if (random.chance(0.5)) {
    if (const auto rules = PairRules::derive(avatar); rules.ok()) options.self = rules.value();
  }
  return options;
}

TEST(WorldExact, ProvesAvatarsByTheirTriangles) {
  WorldTally sum;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(5000 + i));
    BothWorlds both(randomTolerance(random));
    const Vector3d place =
        random.chance(0.2) ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    const bool isOneClock = random.chance(0.5);
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, place + random.inBox(0.3), 0.15);
      if (random.chance(0.3)) walker.avatar = withTwins(walker.avatar, random, 0.6);
      const BodyOptions options = exactOptions(walker.avatar, random, 0.8);
      walk(both, both.add(walker.avatar, options), walker,
           isOneClock ? 33'333 : randomPeriod(random), kWindowUs, random);
    }
    both.judgeAll(isOneClock ? 0 : random.below(40'000), kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 400);
  EXPECT_GT(sum.contact, 40);
  EXPECT_GT(sum.start, 8);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 10);
}

// Meshes against each other, against the scene and against avatars with and without triangles; one
// of them may be a tool in a hand.
TEST(WorldExact, ProvesMeshesAgainstMeshesAndTheScene) {
  WorldTally sum;
  int betweenMeshes = 0, still = 0;
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(6000 + i));
    BothWorlds both(randomMesh(random), WorldOptions{randomTolerance(random), true});
    const BodyId one = both.add(randomMesh(random)), other = both.add(randomMesh(random));
    Walker walker = randomWalker(random, random.inBox(0.4), 0.05);
    const BodyId body = both.add(walker.avatar, exactOptions(walker.avatar, random, 0.5));
    fly(both, one, random.inBox(0.4), randomPeriod(random), kWindowUs, random);
    walk(both, body, walker, randomPeriod(random), kWindowUs, random);
    if (random.chance(0.3)) {
      both.attach(other, {body, random.below(walker.avatar.numLinks())}, 0,
                  RigidPose{random.rotation(), random.inBox(0.2)});
    } else {
      fly(both, other, random.inBox(0.4), randomPeriod(random), kWindowUs, random);
    }
    both.judgeAll(random.below(20'000), kWindowUs);
    for (const WorldContact& contact : both.answer.contacts) {
      if (contact.a.body == one && contact.b.body == other) ++betweenMeshes;
      if (contact.b.body == kStillScene && contact.a.body != body) ++still;
    }
    add(both, sum);
  }
  EXPECT_GT(betweenMeshes, 15);
  EXPECT_GT(still, 25);
  EXPECT_GT(sum.clear, 100);
  EXPECT_GT(sum.contact, 50);
  EXPECT_GT(sum.start, 30);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 10);
}

/// A body's only link with its triangles.
struct Stone {
  Scene mesh;
  Avatar avatar;
  AvatarSurface surface;
};

Stone randomStone(Random& random) {
  RawScene raw;
  raw.objectNames = {"stone"};
  const double size = random.magnitude(0.05, 0.3);
  for (int i = 0; i < 16; ++i) {
    const Vector3d middle = size * random.direction();
    Triangle triangle;
    for (Vector3d& v : triangle.vertices) v = middle + random.inBox(0.4 * size);
    raw.triangles.push_back(triangle);
  }
  raw.objectOf.assign(raw.triangles.size(), 0);
  std::vector<Triangle> triangles = raw.triangles;
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 1.8 * size};
  RawSkeleton one;
  one.joints = {{"stone", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const Avatar avatar = Avatar::build(Skeleton::build(one).value(), {{ball}}).value();
  AvatarSurface surface = AvatarSurface::build(avatar, {std::move(triangles)}).value();
  return {Scene::build(std::move(raw)).value(), avatar, std::move(surface)};
}

// Both hierarchies descend together, or one mesh is the scene that the other is seen from: the same
// promise by another code path.
TEST(WorldExact, AgreesWithTheMeshSeenFromTheOther) {
  int contacts = 0, starts = 0, differ = 0;
  for (int i = 0; i < 120; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(7000 + i));
    const double tolerance = randomTolerance(random);
    const Stone stone = randomStone(random);
    Walker walker = randomWalker(random, random.inBox(0.4), 0.1);
    BodyOptions ofWalker, ofStone;
    ofWalker.surface = randomSurface(walker.avatar, random);
    ofStone.surface = stone.surface;
    BothWorlds both(tolerance), seen(tolerance);
    const BodyId walks = both.add(walker.avatar, ofWalker);
    both.add(stone.avatar, ofStone);
    ASSERT_EQ(seen.add(walker.avatar, ofWalker), walks);
    seen.add(stone.mesh);
    const std::uint64_t way = 8000 + static_cast<std::uint64_t>(i);
    const Vector3d place = random.inBox(0.4);
    for (BothWorlds* world : {&both, &seen}) {
      Random same(way);
      Walker copy = walker;
      walk(*world, 0, copy, 33'333, kWindowUs, same);
      fly(*world, 1, place, 25'000, kWindowUs, same);
      world->judgeAll(0, kWindowUs);
      for (const std::string& problem : world->problems) ADD_FAILURE() << problem;
    }
    contacts += both.tally.contact;
    starts += both.tally.start;
    differ += std::abs(both.tally.clear - seen.tally.clear);
  }
  EXPECT_GT(contacts, 5);
  EXPECT_GT(starts, 0);
  EXPECT_LE(differ, 2) << "grazes within the tolerance alone";
}

// Triangles touch no earlier than what holds them, and what is clear by LSS is clear exactly.
TEST(WorldExact, IsNeverEarlierThanTheLss) {
  int later = 0, clear = 0;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(9000 + i));
    BothWorlds exact(1e-5), byLss(1e-5);
    for (int k = 0; k < 2; ++k) {
      Walker walker = randomWalker(random, random.inBox(0.4), 0.15);
      BodyOptions options;
      options.surface = randomSurface(walker.avatar, random);
      exact.add(walker.avatar, options);
      byLss.add(walker.avatar);
      const auto way = static_cast<std::uint64_t>(random.below(1 << 30));
      for (BothWorlds* world : {&exact, &byLss}) {
        Random same(way);
        Walker copy = walker;
        walk(*world, k, copy, 33'333, kWindowUs, same);
      }
    }
    exact.judgeAll(0, kWindowUs);
    byLss.judgeAll(0, kWindowUs);
    for (const WorldContact& contact : exact.answer.contacts) {
      const auto of = std::find_if(
          byLss.answer.contacts.begin(), byLss.answer.contacts.end(), [&](const WorldContact& c) {
            return c.a.link == contact.a.link && c.b.link == contact.b.link;
          });
      ASSERT_NE(of, byLss.answer.contacts.end());
      EXPECT_FALSE(contact.time < of->time);
      later += of->time < contact.time;
    }
    clear += exact.tally.clear - byLss.tally.clear;
  }
  EXPECT_GT(later, 10);
  EXPECT_GT(clear, 10);
}

// Which of the triangles of both sides: those whose distance is the contact's.
TEST(WorldExact, NamesTheTrianglesOfBothSides) {
  int named = 0;
  for (int i = 0; i < 100; ++i) {
    Random random(static_cast<std::uint64_t>(9500 + i));
    BothWorlds both(1e-5);
    const Stone stone = randomStone(random);
    BodyOptions options;
    options.surface = stone.surface;
    const BodyId one = both.add(stone.avatar, options), other = both.add(stone.mesh);
    fly(both, one, random.inBox(0.3), 33'333, kWindowUs, random);
    fly(both, other, random.inBox(0.3), 33'333, kWindowUs, random);
    both.judgeAll(0, kWindowUs);
    for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
    for (const WorldContact& contact : both.answer.contacts) {
      if (contact.verdict != Verdict::Contact) continue;
      ASSERT_GE(contact.a.triangle, 0);
      ASSERT_GE(contact.b.triangle, 0);
      EXPECT_EQ(contact.a.lss, 0);
      EXPECT_EQ(contact.b.lss, -1);
      // The judge measures those two alone.
      for (int body = 0; body < 2; ++body) {
        std::vector<OraclePart>& parts = both.oracle.bodies[slotOf(body)].parts;
        const OraclePart part = parts[slotOf((body == 0 ? contact.a : contact.b).triangle)];
        parts.assign(1, part);
      }
      const double at = microsecondsAfter(0, contact.time);
      EXPECT_NEAR(static_cast<double>(both.oracle.separationAt(0, 0, 1, 0, 0, at)),
                  contact.separation, 1e-9);
      ++named;
    }
  }
  EXPECT_GT(named, 8);
}

}  // namespace
}  // namespace foretouch::test
