// Depths of a world's bodies at an instant, held against the judge's own world.
#include <string>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "middleware/depth/depth.h"
#include "tests/middleware/depth/depth_pieces.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::DepthPiece;
using test::BothWorlds;
using test::Real;

Skeleton skeletonOf(int joints) {
  RawSkeleton raw;
  for (int j = 0; j < joints; ++j) {
    raw.joints.push_back({"joint" + std::to_string(j), j - 1,
                          j == 0 ? Vector3d(Vector3d::Zero()) : Vector3d(0, 0.15, 0),
                          Quaternion::Identity()});
  }
  return Skeleton::build(raw).value();
}

/// An arm of three links.
Avatar arm() {
  std::vector<std::vector<Lss>> lss(3);
  for (auto& link : lss) link = {{Vector3d::Zero(), Vector3d(0, 0.15, 0), 0.03}};
  return Avatar::build(skeletonOf(3), lss).value();
}

Scene block() {
  RawScene raw;
  raw.objectNames = {"block"};
  raw.triangles = {{{Vector3d(-0.3, 0, -0.3), Vector3d(0.3, 0, -0.3), Vector3d(0, 0, 0.4)}},
                   {{Vector3d(-0.3, 0, -0.3), Vector3d(0.3, 0, -0.3), Vector3d(0, 0.2, 0)}},
                   {{Vector3d(0.3, 0, -0.3), Vector3d(0, 0, 0.4), Vector3d(0, 0.2, 0)}}};
  raw.objectOf = {0, 0, 0};
  return Scene::build(std::move(raw)).value();
}

Pose randomPose(test::Random& random, const Skeleton& skeleton, double reach) {
  Pose pose = restPose(skeleton);
  for (auto& rotation : pose.rotations) rotation = random.turn(random.uniform(0.0, 1.2));
  pose.translations[0] = random.inBox(reach);
  return pose;
}

std::vector<DepthPiece> piecesOf(const std::vector<test::OraclePart>& parts) {
  std::vector<DepthPiece> pieces;
  for (const test::OraclePart& part : parts) {
    pieces.push_back({part.count, part.corners, part.radius});
  }
  return pieces;
}

/// The judge moves the body by the way out, and by shorter ones.
void check(const BothWorlds& both, const WorldTime& time, const DepthQuestion& question,
           test::Random& random, int& deep) {
  Scratch scratch;
  const auto asked = both.world.depth(time, question, scratch);
  ASSERT_TRUE(asked.ok()) << describe(asked.error());
  const Depth& depth = asked.value().depth;
  const auto us = static_cast<Real>(time.us) + static_cast<Real>(time.fraction);
  const auto moved = piecesOf(both.oracle.partsAt(question.a, question.linkOfA, 0, us));
  const auto others = piecesOf(both.oracle.partsAt(question.b, question.linkOfB, 0, us));
  const Real separation = oracle::separationAfter(moved, {}, others);
  if (separation > 1e-10L) {
    EXPECT_EQ(depth.upper, 0.0);
    return;
  }
  ++deep;
  ASSERT_TRUE(depth.isCertified);
  ASSERT_GE(oracle::separationAfter(moved, oracle::Vec3d(depth.wayOut), others), -1e-15L);
  ASSERT_GE(depth.upper, depth.wayOut.norm());
  for (int i = 0; i < 40 && depth.lower > 0.0; ++i) {
    const Vector3d shorter = random.uniform(0.5, 0.999) * depth.lower * random.direction();
    ASSERT_LE(oracle::separationAfter(moved, oracle::Vec3d(shorter), others), 1e-14L);
  }
  EXPECT_EQ(asked.value().a.body, question.a);
  EXPECT_EQ(asked.value().b.body, question.b);
}

TEST(WorldDepth, OfBodiesThatMoveAndAreCarriedAgreesWithTheJudge) {
  int deep = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    BothWorlds both(1e-3);
    const Avatar avatar = arm();
    const BodyId one = both.add(avatar), other = both.add(avatar), mesh = both.add(block());
    const BodyId tool = both.add(block());
    for (const std::int64_t us : {0, 30'000, 75'000, 100'000}) {
      both.push(one, us, randomPose(random, avatar.skeleton(), 0.15));
      both.push(other, us == 75'000 ? 60'000 : us, randomPose(random, avatar.skeleton(), 0.15));
      both.push(mesh, us, RigidPose{random.turn(1.0), random.inBox(0.1)});
    }
    both.push(tool, 0, RigidPose{});
    both.push(tool, 10'000, RigidPose{});
    both.attach(tool, {one, 2, false}, 10'000, RigidPose{random.turn(1.0), Vector3d(0, 0.1, 0)});
    for (int k = 0; k < 8; ++k) {
      const WorldTime time{10'000 + random.below(89'999), random.uniform(0.0, 1.0)};
      check(both, time, {one, kEveryLink, other, kEveryLink}, random, deep);
      check(both, time, {one, random.below(3), mesh, kEveryLink}, random, deep);
      check(both, time, {mesh, kEveryLink, other, kEveryLink}, random, deep);
      check(both, time, {other, kEveryLink, tool, 0}, random, deep);
      check(both, time, {one, 0, one, 2}, random, deep);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(deep, 400);
}

TEST(WorldDepth, OfTheStillSceneIsInItsFrame) {
  RawScene floor;
  floor.objectNames = {"floor"};
  floor.triangles = {{{Vector3d(-9, 0, -9), Vector3d(9, 0, -9), Vector3d(0, 0, 9)}}};
  floor.objectOf = {0};
  World world = World::build(Scene::build(floor).value()).value();
  const BodyId body = world.add(arm()).value();
  Pose pose = restPose(arm().skeleton());
  pose.translations[0] = Vector3d(0, -0.02, 0);
  ASSERT_TRUE(world.push(body, 0, pose).ok());
  ASSERT_TRUE(world.push(body, 1000, pose).ok());
  Scratch scratch;
  const auto depth = world.depth({500, 0.5}, {body}, scratch).value();
  EXPECT_NEAR(depth.depth.lower, 0.05, 1e-12);
  EXPECT_NEAR(depth.depth.wayOut.y(), 0.05, 1e-10);
  EXPECT_EQ(depth.a.link, 0);
  EXPECT_EQ(depth.b.triangle, 0);
  EXPECT_FALSE(depth.isAssumed);
}

TEST(WorldDepth, RefusesWhatCannotBeAsked) {
  World world = World::build(std::nullopt).value();
  const BodyId body = world.add(arm()).value(), mesh = world.add(block()).value();
  BodyOptions holds;
  holds.whenSilent = WhenSilent::HoldStill;
  const BodyId held = world.add(arm(), holds).value(), other = world.add(block()).value();
  ASSERT_TRUE(world.push(body, 0, restPose(arm().skeleton())).ok());
  ASSERT_TRUE(world.push(mesh, 0, RigidPose{}).ok());
  ASSERT_TRUE(world.push(held, 0, restPose(arm().skeleton())).ok());
  ASSERT_TRUE(world.push(other, 100, RigidPose{}).ok());
  BodyOptions byTriangles;
  byTriangles.surface =
      AvatarSurface::build(arm(), std::vector<std::vector<Triangle>>(countOf(arm().numLinks())))
          .value();
  const BodyId exact = world.add(arm(), byTriangles).value();
  ASSERT_TRUE(world.push(exact, 0, restPose(arm().skeleton())).ok());
  Scratch scratch;
  const auto errorOf = [&](const WorldTime& time, const DepthQuestion& question) {
    const auto asked = world.depth(time, question, scratch);
    return asked.ok() ? std::string() : describe(asked.error());
  };
  EXPECT_EQ(errorOf({0, 0.0}, {body, kEveryLink, mesh, kEveryLink}), "");
  EXPECT_NE(errorOf({0, 0.0}, {body, 3, mesh, 0}), "");
  EXPECT_NE(errorOf({0, 0.0}, {body, 0, 9, 0}), "");
  EXPECT_NE(errorOf({0, 0.0}, {exact, 0, mesh, 0}).find("by its LSS"), std::string::npos);
  EXPECT_NE(errorOf({0, 0.0}, {body}).find("stands still"), std::string::npos);
  EXPECT_NE(errorOf({0, 0.0}, {mesh, 0, other, 0}).find("made of LSS"), std::string::npos);
  EXPECT_NE(errorOf({0, 0.0}, {body, 1, body, 1}).find("two different links"), std::string::npos);
  EXPECT_NE(errorOf({1, 0.0}, {body, 0, mesh, 0}).find("silent"), std::string::npos);
  EXPECT_NE(errorOf({50, 0.0}, {held, 0, other, 0}).find("not there"), std::string::npos);
  EXPECT_NE(errorOf({0, 1.0}, {body, 0, mesh, 0}).find("fraction"), std::string::npos);
  EXPECT_NE(errorOf({0, 0.0}, {kStillScene, 0, body, 0}), "");
  EXPECT_TRUE(world.depth({100, 0.0}, {held, 0, other, 0}, scratch).value().isAssumed);
}

}  // namespace
}  // namespace foretouch
