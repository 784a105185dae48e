// What a world is told, what it refuses, and what it says of what it does not know.
#include "middleware/world/world.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/middleware/balls.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::at;
using test::ball;
using test::BothWorlds;

Skeleton skeletonOf(int joints) {
  RawSkeleton raw;
  for (int j = 0; j < joints; ++j) {
    raw.joints.push_back(
        {"joint" + std::to_string(j), j - 1, Vector3d::Zero(), Quaternion::Identity()});
  }
  return Skeleton::build(raw).value();
}

/// A ball of this radius.
/// A square of 2 m across x, at x = 0.
Scene wall() {
  RawScene raw;
  raw.objectNames = {"wall"};
  raw.triangles = {{{Vector3d(0, -1, -1), Vector3d(0, 1, -1), Vector3d(0, 1, 1)}},
                   {{Vector3d(0, -1, -1), Vector3d(0, 1, 1), Vector3d(0, -1, 1)}}};
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

World emptyWorld() {
  return World::build(std::nullopt).value();
}

WorldContacts answerOf(const World& world, std::int64_t fromUs, std::int64_t toUs) {
  Scratch scratch;
  WorldContacts answer;
  const auto asked = world.contacts(fromUs, toUs, scratch, answer);
  EXPECT_TRUE(asked.ok()) << describe(asked.error());
  return answer;
}

void expectError(const Result<Done>& result, ErrorCode code, const std::string& words) {
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, code) << describe(result.error());
  EXPECT_NE(describe(result.error()).find(words), std::string::npos) << describe(result.error());
}

// Two balls of 10 cm, a metre apart, one of which closes in at 1 m in 100 ms: they touch at 80 ms.
TEST(World, SaysWhenAndWhereTwoMeet) {
  World world = emptyWorld();
  const BodyId one = world.add(ball(0.1)).value(), other = world.add(ball(0.1)).value();
  for (const int i : {0, 1, 2}) {
    ASSERT_TRUE(world.push(one, 50'000 * i, at(0.5 * i)).ok());
    ASSERT_TRUE(world.push(other, 33'000 * i, at(1.0)).ok());
  }
  ASSERT_TRUE(world.push(other, 100'000, at(1.0)).ok());
  const WorldContacts answer = answerOf(world, 0, 100'000);
  ASSERT_EQ(answer.contacts.size(), 1u);
  const WorldContact& contact = answer.contacts[0];
  EXPECT_EQ(contact.a.body, one);
  EXPECT_EQ(contact.b.body, other);
  EXPECT_EQ(contact.verdict, Verdict::Contact);
  const double us = microsecondsAfter(0, contact.time);
  EXPECT_LE(us, 80'000.0);
  EXPECT_GE(us, 80'000.0 - 1e-3 * 1e5 - 1e-6);
  EXPECT_LE(contact.separation, 1e-3);
  EXPECT_NEAR(contact.b.p_W.x(), 0.9, 1e-12);
  EXPECT_NEAR((contact.nhat_BA_W - Vector3d(-1, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_FALSE(contact.isAssumed);
  EXPECT_TRUE(answer.silent.empty());
}

// Each goes where the other has been: what both sweep meets, they do not.
TEST(World, IsClearOfTwoThatMoveTogether) {
  for (const bool isMesh : {false, true}) {
    BothWorlds both(1e-3);
    const BodyId one = both.add(ball(0.05));
    const BodyId other = isMesh ? both.add(wall()) : both.add(ball(0.05));
    const double apart = isMesh ? 0.07 : 0.12;  // 2 cm between the surfaces
    for (const int i : {0, 1, 2, 3}) {
      both.push(one, 20'000 * i, at(0.1 * i));
      both.push(other, 15'000 * i, at(0.075 * i + apart));
    }
    both.judgeAll(0, 45'000);
    EXPECT_TRUE(both.problems.empty()) << both.problems.front();
    EXPECT_EQ(both.tally.clear, 1);
    EXPECT_EQ(both.answer.counters.nearPairs, 1u);
  }
}

TEST(World, TellsTheStaticSceneAndOwnLinks) {
  World world = World::build(wall()).value();
  // Three balls in a row along x, the last of which swings around the first.
  const Avatar avatar =
      Avatar::build(skeletonOf(3), {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}},
                                    {},
                                    {{Vector3d(0.3, 0, 0), Vector3d(0.3, 0, 0), 0.1}}})
          .value();
  BodyOptions options;
  options.self = PairRules::leavingOut(avatar, {}).value();
  const BodyId body = world.add(avatar, options).value();
  Pose from = restPose(avatar.skeleton()), to = from;
  from.translations[0] = to.translations[0] = Vector3d(-1, 0, 0);
  to.translations[0].x() = -0.4;              // the first ends 30 cm before the wall
  to.translations[2] = Vector3d(-0.2, 0, 0);  // the last comes to 10 cm of the first
  ASSERT_TRUE(world.push(body, 0, from).ok());
  ASSERT_TRUE(world.push(body, 1000, to).ok());
  const WorldContacts answer = answerOf(world, 0, 1000);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].a.link, 0);
  EXPECT_EQ(answer.contacts[0].b.body, body);
  EXPECT_EQ(answer.contacts[0].b.link, 2);
  // Now into the wall as well, from the window's middle.
  to.translations[0].x() = 0.2;
  ASSERT_TRUE(world.push(body, 2000, to).ok());
  const WorldContacts next = answerOf(world, 1000, 2000);
  ASSERT_EQ(next.contacts.size(), 3u);
  EXPECT_EQ(std::count_if(next.contacts.begin(), next.contacts.end(),
                          [](const WorldContact& c) { return c.b.body == kStillScene; }),
            2);
  ASSERT_TRUE(world.askStill(0, false).ok());
  EXPECT_EQ(answerOf(world, 1000, 2000).contacts.size(), 1u);
}

TEST(World, AsksEachBodyByItsOwnRadiiOfPairs) {
  World world = emptyWorld();
  // The first touches both others, which do not touch each other.
  const auto ballAt = [](double x) { return Lss{Vector3d(x, 0, 0), Vector3d(x, 0, 0), 0.1}; };
  const Avatar avatar =
      Avatar::build(skeletonOf(3), {{ballAt(0.0)}, {ballAt(0.15)}, {ballAt(-0.15)}}).value();
  const auto add = [&](const std::vector<PairRadius>& radii) {
    BodyOptions options;
    options.self = PairRules::leavingOut(avatar, {}, radii).value();
    const BodyId body = world.add(avatar, options).value();
    Pose pose = restPose(avatar.skeleton());
    pose.translations[0].y() = body;
    for (const int us : {0, 1000}) EXPECT_TRUE(world.push(body, us, pose).ok());
    return body;
  };
  const BodyId both = add({}), other = add({{0, 0, 1, 0, 0.1}}), one = add({{0, 0, 2, 0, 0.1}});
  const BodyId bothStill = add({{0, 0, 1, 0, 0.16}});
  std::vector<std::pair<BodyId, LinkId>> found;
  for (const WorldContact& contact : answerOf(world, 0, 1000).contacts) {
    found.emplace_back(contact.a.body, contact.b.link);
  }
  std::sort(found.begin(), found.end());
  const std::vector<std::pair<BodyId, LinkId>> expected{{both, 1}, {both, 2},      {other, 2},
                                                        {one, 1},  {bothStill, 1}, {bothStill, 2}};
  EXPECT_EQ(found, expected);
}

// Until a past is forgotten, somebody may still be said to have been carried in it: what a scratch
// knows of a piece does not outlive that.
TEST(World, BelievesWhatItIsToldOfThePast) {
  World world = World::build(wall()).value();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  for (BodyId body = 0; body < 2; ++body) {
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(world.push(body, 10 * i, at(-50.0 + 10 * body)).ok());
  }
  Scratch scratch;
  WorldContacts answer;
  ASSERT_TRUE(world.contacts(20, 30, scratch, answer).ok());
  EXPECT_TRUE(answer.contacts.empty());
  ASSERT_TRUE(world.attach(0, {1, 0}, 15, at(5)).ok());
  ASSERT_TRUE(world.detach(0, 20, at(-0.05)).ok());
  ASSERT_TRUE(world.push(0, 30, at(-0.05)).ok());
  ASSERT_TRUE(world.contacts(20, 30, scratch, answer).ok());
  EXPECT_EQ(answer.contacts.size(), 1u);
}

TEST(World, AsksTheSceneOnlyWhileItIsAsked) {
  World world = World::build(wall()).value();
  ASSERT_TRUE(world.add(ball(0.5)).ok());
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(world.push(0, 1000 * i, at(-2.0 + i)).ok());
  // What a scratch knows of a piece, it knows of one question.
  Scratch scratch;
  WorldContacts answer;
  for (const bool isAsked : {true, false, true, true}) {
    ASSERT_TRUE(world.askStill(0, isAsked).ok());
    ASSERT_TRUE(world.contacts(1500, 1600, scratch, answer).ok());
    ASSERT_TRUE(world.contacts(0, 2500, scratch, answer).ok());
    EXPECT_EQ(answer.contacts.size(), isAsked ? 1u : 0u);
  }
}

TEST(World, AsksWhatItsGroupsAreAsked) {
  World world = emptyWorld();
  BodyOptions second;
  second.group = 3;
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1), second).ok());
  ASSERT_TRUE(world.add(ball(0.1), second).ok());
  for (BodyId body = 0; body < 3; ++body) {
    ASSERT_TRUE(world.push(body, 0, at(0.05 * body)).ok());
    ASSERT_TRUE(world.push(body, 10, at(0.05 * body)).ok());
  }
  EXPECT_EQ(answerOf(world, 0, 10).contacts.size(), 3u);
  ASSERT_TRUE(world.ask(3, 0, false).ok());
  const WorldContacts answer = answerOf(world, 0, 10);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].a.body, 1);
  EXPECT_EQ(answer.contacts[0].verdict, Verdict::StartsInContact);
  expectError(world.ask(0, 32, true), ErrorCode::OutOfRange, "found 32");
  expectError(world.askStill(-1, true), ErrorCode::OutOfRange, "found -1");
}

TEST(World, WaitsForWhoWaits) {
  World world = emptyWorld();
  EXPECT_FALSE(world.knownUntilUs());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.push(0, 0, at(0)).ok());
  ASSERT_TRUE(world.push(0, 90, at(0)).ok());
  ASSERT_TRUE(world.push(1, 10, at(5)).ok());
  EXPECT_EQ(world.knownUntilUs(), 10);
  EXPECT_EQ(world.waitsFor(), 1);
  Scratch scratch;
  WorldContacts answer;
  expectError(world.contacts(0, 50, scratch, answer), ErrorCode::OutOfRange, "of body 1");
  ASSERT_TRUE(world.push(1, 60, at(5)).ok());
  EXPECT_TRUE(world.contacts(0, 50, scratch, answer).ok());
  expectError(world.contacts(50, 50, scratch, answer), ErrorCode::OutOfRange, "no length");
  expectError(emptyWorld().contacts(0, 50, scratch, answer), ErrorCode::Empty, "no body");
}

TEST(World, SaysWhatItTakesASilentBodyToDo) {
  for (const WhenSilent taken : {WhenSilent::HoldStill, WhenSilent::Undecided}) {
    World world = emptyWorld();
    BodyOptions silent;
    silent.whenSilent = taken;
    ASSERT_TRUE(world.add(ball(0.1)).ok());
    ASSERT_TRUE(world.add(ball(0.1), silent).ok());
    ASSERT_TRUE(world.push(0, 0, at(0)).ok());
    ASSERT_TRUE(world.push(0, 100, at(1)).ok());
    ASSERT_TRUE(world.push(1, 0, at(0.7)).ok());
    ASSERT_TRUE(world.push(1, 20, at(0.7)).ok());
    EXPECT_EQ(world.knownUntilUs(), 100);
    const WorldContacts answer = answerOf(world, 0, 100);
    ASSERT_EQ(answer.silent.size(), 1u);
    EXPECT_EQ(answer.silent[0].body, 1);
    EXPECT_EQ(answer.silent[0].sinceUs, 20);
    EXPECT_EQ(answer.silent[0].takenTo, taken);
    if (taken == WhenSilent::Undecided) {
      EXPECT_TRUE(answer.contacts.empty());
      continue;
    }
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_NEAR(microsecondsAfter(0, answer.contacts[0].time), 50.0, 0.2);
    EXPECT_TRUE(answer.contacts[0].isAssumed);
  }
}

TEST(World, HasABodyFromItsFirstPoseOn) {
  World world = emptyWorld();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.push(0, 0, at(0)).ok());
  ASSERT_TRUE(world.push(0, 100, at(0)).ok());
  ASSERT_TRUE(world.push(1, 40, at(0.1)).ok());
  ASSERT_TRUE(world.push(1, 100, at(0.1)).ok());
  EXPECT_TRUE(answerOf(world, 0, 40).contacts.empty());
  const WorldContacts answer = answerOf(world, 0, 100);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].verdict, Verdict::StartsInContact);
  EXPECT_EQ(answer.contacts[0].time.us, 40);
}

TEST(World, RefusesByName) {
  World world = emptyWorld();
  EXPECT_FALSE(World::build(std::nullopt, {1e-9}).ok());
  BodyOptions options;
  options.group = 40;
  EXPECT_FALSE(world.add(ball(0.1), options).ok());
  options.group = 0;
  const Avatar two = Avatar::build(skeletonOf(2), {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}},
                                                   {{Vector3d(1, 0, 0), Vector3d(1, 0, 0), 0.1}}})
                         .value();
  options.self = PairRules::leavingOut(two, {}).value();
  EXPECT_FALSE(world.add(ball(0.1), options).ok());
  EXPECT_FALSE(world.add(wall(), options).ok());
  ASSERT_TRUE(world.add(two, options).ok());
  expectError(world.push(7, 0, at(0)), ErrorCode::UnknownName, "body 7 is unknown");
  expectError(world.push(-1, 0, at(0)), ErrorCode::UnknownName, "body -1");
  expectError(world.push(0, 0, at(0)), ErrorCode::Mismatch, "2 joints");
  EXPECT_EQ(world.knownUntilUs(), std::nullopt);  // what was refused has left no trace
}

/// The corners of a cube of this half length, as triangles.
Scene corners(double half) {
  RawScene raw;
  raw.objectNames = {"corners"};
  const auto corner = [half](int x, int y, int z) -> Vector3d { return half * Vector3d(x, y, z); };
  raw.triangles = {{{corner(-1, -1, -1), corner(1, 1, -1), corner(1, -1, 1)}},
                   {{corner(-1, 1, 1), corner(1, 1, 1), corner(-1, -1, 1)}}};
  raw.objectOf = {0, 0};
  return Scene::build(std::move(raw)).value();
}

// Every corner within the limit, and the LSS around them all is beyond it: no question could be
// asked about it. One that is within it answers.
TEST(World, RefusesMeshesWhoseLssLeaveTheLimit) {
  for (const bool asksMeshes : {false, true}) {
    WorldOptions options;
    options.askMeshes = asksMeshes;
    World world = World::build(std::nullopt, options).value();
    const auto refused = world.add(corners(kMaxCoordinate));
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfRange);
    EXPECT_NE(describe(refused.error()).find("beyond 1e7 m"), std::string::npos);
    EXPECT_EQ(world.numBodies(), 0);
    ASSERT_TRUE(world.add(corners(0.5 * kMaxCoordinate)).ok());
    ASSERT_TRUE(world.add(ball(0.1)).ok());
    for (const std::int64_t us : {0, 100}) {
      ASSERT_TRUE(world.push(0, us, at(0.0)).ok());
      ASSERT_TRUE(world.push(1, us, at(0.5 * kMaxCoordinate, 0.5 * kMaxCoordinate)).ok());
    }
    Scratch scratch;
    WorldContacts answer;
    EXPECT_TRUE(world.contacts(0, 100, scratch, answer).ok());
  }
}

TEST(World, RefusesSurfacesOfOthers) {
  World world = emptyWorld();
  const Avatar own = ball(0.1);
  const Triangle small{{Vector3d(0.01, 0, 0), Vector3d(0.02, 0, 0), Vector3d(0, 0.01, 0)}};
  BodyOptions options;
  options.surface = AvatarSurface::build(own, {{small}}).value();
  EXPECT_TRUE(world.add(own, options).ok());
  const auto mesh = world.add(wall(), options);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().file, "surface");
  RawSkeleton raw;
  raw.joints = {{"a", kNoParent, {0, 0, 0}, Quaternion::Identity()},
                {"b", 0, {1, 0, 0}, Quaternion::Identity()}};
  const Lss lss{{0, 0, 0}, {0, 0, 0}, 0.6};
  const Avatar two = Avatar::build(Skeleton::build(raw).value(), {{lss}, {lss}}).value();
  const auto other = world.add(two, options);
  ASSERT_FALSE(other.ok());
  EXPECT_EQ(other.error().file, "surface");
  options.surface = AvatarSurface::build(two, {{}, {}}).value();
  options.self = PairRules::leavingOut(two, {}, {{0, 0, 1, 0, 0.9}}).value();
  const auto smaller = world.add(two, options);
  ASSERT_FALSE(smaller.ok());
  EXPECT_EQ(smaller.error().file, "self");
}

// What a mesh carries: a body that is held fast is not asked about it; of one that moves there, the
// links beyond its root are.
TEST(World, AMeshIsNotAskedAboutWhoStandsOnIt) {
  RawSkeleton raw;
  raw.joints = {{"foot", kNoParent, Vector3d::Zero(), Quaternion::Identity()},
                {"hand", 0, Vector3d(0, 0.5, 0), Quaternion::Identity()}};
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.1};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}}).value();
  for (const bool moves : {false, true}) {
    World world = emptyWorld();
    const BodyId lift = world.add(wall()).value(), rider = world.add(avatar).value();
    for (const int us : {0, 100}) ASSERT_TRUE(world.push(lift, us, at(0.01 * us)).ok());
    const Pose inside = restPose(avatar.skeleton());
    ASSERT_TRUE(world.attach(rider, {lift, 0, moves}, 0, inside).ok());
    if (moves) {
      ASSERT_TRUE(world.push(rider, 100, inside).ok());
    }
    const WorldContacts answer = answerOf(world, 0, 100);
    ASSERT_EQ(answer.contacts.size(), moves ? 1u : 0u);
    if (moves) {
      EXPECT_EQ(answer.contacts[0].verdict, Verdict::StartsInContact);
      const ContactSide& side =
          answer.contacts[0].a.body == rider ? answer.contacts[0].a : answer.contacts[0].b;
      EXPECT_EQ(side.link, 1);
    }
  }
}

TEST(World, KeepsAlikeRulesOnce) {
  World world = emptyWorld();
  RawSkeleton raw;
  for (const char* name : {"a", "b", "c"}) {
    raw.joints.push_back({name, kNoParent, Vector3d::Zero(), Quaternion::Identity()});
  }
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.1};
  const Avatar avatar =
      Avatar::build(Skeleton::build(raw).value(), {{ball}, {ball}, {ball}}).value();
  const auto add = [&](std::vector<LeftOutPair> leftOut) {
    BodyOptions options;
    options.self = PairRules::leavingOut(avatar, std::move(leftOut), {}).value();
    EXPECT_TRUE(world.add(avatar, options).ok());
    return world.parts().rules.size();
  };
  EXPECT_EQ(add({{0, 1, PairReason::User}}), 1u);
  EXPECT_EQ(add({{0, 1, PairReason::User}}), 1u);
  EXPECT_EQ(add({{0, 2, PairReason::User}}), 2u);
  EXPECT_EQ(add({{0, 1, PairReason::User}, {1, 2, PairReason::User}}), 3u);
}

// Two walls that cross, and a still one: nothing is said of them unless the world asks meshes.
TEST(World, AsksMeshesWhereItIsTold) {
  for (const bool asksMeshes : {false, true}) {
    WorldOptions options;
    options.askMeshes = asksMeshes;
    World world = World::build(wall(), options).value();
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(world.add(wall()).ok());
      ASSERT_TRUE(world.push(i, 0, at(1.0 + i)).ok());
      ASSERT_TRUE(world.push(i, 100, at(0.5 - i)).ok());
    }
    const WorldContacts answer = answerOf(world, 0, 100);
    EXPECT_EQ(answer.contacts.size(), asksMeshes ? 2u : 0u);
    for (const WorldContact& contact : answer.contacts) {
      EXPECT_EQ(contact.verdict, Verdict::Contact);
      EXPECT_EQ(contact.a.lss, -1);
      EXPECT_GE(contact.a.triangle, 0);
      EXPECT_GE(contact.b.triangle, 0);
    }
    ASSERT_TRUE(world.ask(0, 0, false).ok());
    ASSERT_TRUE(world.askStill(0, false).ok());
    EXPECT_TRUE(answerOf(world, 0, 100).contacts.empty());
  }
}

TEST(World, RefusesCirclesOfCarriers) {
  World world = emptyWorld();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(world.add(ball(0.1)).ok());
    ASSERT_TRUE(world.push(i, 0, at(i)).ok());
    ASSERT_TRUE(world.push(i, 100, at(i)).ok());
  }
  expectError(world.attach(0, {0, 0}, 50, at(1)), ErrorCode::BadHierarchy, "body 0 carries body 0");
  ASSERT_TRUE(world.attach(0, {1, 0}, 50, at(1)).ok());
  ASSERT_TRUE(world.attach(1, {2, 0}, 60, at(1)).ok());
  expectError(world.attach(2, {0, 0}, 70, at(1)), ErrorCode::BadHierarchy, "does not hang on it");
  // Before the other is attached, too: it would be one later.
  expectError(world.attach(2, {0, 0}, 40, at(1)), ErrorCode::BadHierarchy, "does not hang on it");
  ASSERT_TRUE(world.detach(0, 80, at(1)).ok());
  EXPECT_TRUE(world.attach(2, {0, 0}, 90, at(1)).ok());
}

// Who hangs on whom is asked instant by instant: 1 hangs on 0, and 0 on 2, while 2 does not hang on
// 1, and the other way round.
TEST(World, CarriesInCirclesThatAreNeverClosed) {
  BothWorlds both(1e-4);
  for (int i = 0; i < 3; ++i) {
    both.add(ball(0.1));
    both.push(i, 0, at(3.0 * i));
    both.push(i, 100, at(3.0 * i));
  }
  both.add(ball(0.1));  // in whose way 1 and 2 come, carried
  both.push(3, 0, at(0.9));
  both.push(3, 100, at(0.9));
  both.attach(1, {0, 0, false}, 10, at(3.0));
  both.detach(1, 20, at(3.0));
  both.push(1, 100, at(3.0));
  both.attach(0, {1, 0, false}, 20, at(-3.0));
  both.detach(0, 30, at(0.0));
  both.push(0, 100, at(-1.0));
  // Later than 1 hangs on 0 and 0 on 1, and before 2 does on anybody.
  both.attach(1, {2, 0, false}, 40, at(-3.0));
  both.attach(2, {0, 0, true}, 35, at(6.0));
  both.push(2, 100, at(0.15));
  ASSERT_TRUE(both.problems.empty()) << both.problems.front();
  both.judgeAll(0, 100);
  for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
  EXPECT_GT(both.tally.contact, 0);
}

// A person of hips and a foot on a lift of LSS, and on one of triangles. While he moves in its
// frame his foot stands on it, and his hips are where he hangs on it; put there fast, he is as a
// part of it.
TEST(World, AsksARiderWhoMovesAboutHisCarrierAndNotOneWhoIsHeldFast) {
  const Lss hips{Vector3d::Zero(), Vector3d::Zero(), 0.1};
  const Avatar person = Avatar::build(skeletonOf(2), {{hips}, {hips}}).value();
  Pose standing;
  standing.rotations.assign(2, Quaternion::Identity());
  standing.translations = {Vector3d(0.05, 0.0, 0.0), Vector3d(0.0, 0.5, 0.0)};
  for (const bool isMesh : {false, true}) {
    for (const bool moves : {false, true}) {
      BothWorlds both(1e-4);
      const Lss pole{Vector3d(0, -1, 0), Vector3d(0, 1, 0), 0.1};
      const BodyId lift =
          isMesh ? both.add(wall()) : both.add(Avatar::build(skeletonOf(1), {{pole}}).value());
      const BodyId rider = both.add(person);
      for (const std::int64_t us : {0, 100}) {
        both.push(lift, us, at(0.0, 0.01 * static_cast<double>(us)));
        both.push(rider, us, standing);
      }
      both.attach(rider, {lift, 0, moves}, 50, standing);
      if (moves) both.push(rider, 100, standing);
      const WorldContacts answer = answerOf(both.world, 50, 100);
      ASSERT_EQ(answer.contacts.size(), moves ? 1u : 0u) << isMesh;
      if (moves) {
        EXPECT_EQ(answer.contacts[0].b.link, 1);
        EXPECT_EQ(answer.contacts[0].verdict, Verdict::StartsInContact);
      }
      both.judge(lift, rider, 50, 100);
      for (const std::string& problem : both.problems) ADD_FAILURE() << problem;
    }
  }
}

// Deeper than any skeleton may be, no question could be asked.
TEST(World, RefusesTowersThatAreTooDeep) {
  World world = emptyWorld();
  const Avatar one = ball(0.1);
  for (BodyId i = 0; i < kMaxChainDepth; ++i) {
    ASSERT_TRUE(world.add(one).ok());
    ASSERT_TRUE(world.push(i, 0, at(i)).ok());
    ASSERT_TRUE(world.push(i, 100, at(i)).ok());
    if (i == 0) continue;
    ASSERT_TRUE(world.attach(i, {i - 1, 0, false}, 50, at(1.0)).ok()) << i;
  }
  EXPECT_TRUE(answerOf(world, 0, 100).contacts.empty());
  ASSERT_TRUE(world.add(one).ok());
  ASSERT_TRUE(world.push(kMaxChainDepth, 0, at(kMaxChainDepth)).ok());
  ASSERT_TRUE(world.push(kMaxChainDepth, 100, at(kMaxChainDepth)).ok());
  expectError(world.attach(kMaxChainDepth, {kMaxChainDepth - 1, 0, false}, 50, at(1.0)),
              ErrorCode::LimitExceeded, "256 bodies");
}

// A tower that is built from its top down, each upon the next: no attachment is deep by itself.
TEST(World, RefusesToAnswerAboutATowerThatIsTooDeep) {
  World world = emptyWorld();
  const Avatar one = ball(0.1);
  constexpr BodyId kCount = 20'000;
  for (BodyId i = 0; i < kCount; ++i) {
    ASSERT_TRUE(world.add(one).ok());
    ASSERT_TRUE(world.push(i, 0, at(i)).ok());
    ASSERT_TRUE(world.push(i, 100, at(i)).ok());
    if (i == 0) continue;
    ASSERT_TRUE(world.attach(i - 1, {i, 0, false}, 50, at(1.0)).ok()) << i;
  }
  Scratch scratch;
  WorldContacts answer;
  expectError(world.contacts(0, 100, scratch, answer), ErrorCode::LimitExceeded, "");
}

TEST(World, RefusesCarriersThatAreNotThere) {
  World world = emptyWorld();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.push(0, 0, at(0)).ok());
  ASSERT_TRUE(world.push(0, 100, at(0)).ok());
  ASSERT_TRUE(world.push(1, 50, at(0)).ok());
  expectError(world.attach(0, {9, 0}, 60, at(1)), ErrorCode::UnknownName, "body 9");
  expectError(world.attach(0, {1, 4}, 60, at(1)), ErrorCode::UnknownName, "found 4");
  expectError(world.attach(0, {1, 0}, 40, at(1)), ErrorCode::OutOfRange, "not there at 40");
  expectError(world.attach(0, {2, 0}, 60, at(1)), ErrorCode::OutOfRange, "not there at 60");
  expectError(world.attach(0, {1, 0}, 101, at(1)), ErrorCode::OutOfRange, "known until 100");
  expectError(world.detach(0, 60, at(1)), ErrorCode::Mismatch, "not carried");
  ASSERT_TRUE(world.attach(0, {1, 0}, 60, at(1)).ok());
  expectError(world.push(0, 200, at(1)), ErrorCode::Mismatch, "held fast by body 1");
  expectError(world.detach(0, 60, at(1)), ErrorCode::OutOfRange, "expected a later instant");
  // In a hand from its first instant on.
  EXPECT_TRUE(world.attach(2, {1, 0}, 70, at(1)).ok());
  EXPECT_EQ(world.knownUntilUs(), 50);  // who carries is waited for, who is held is not
}

TEST(World, ForgetsWhatIsAnswered) {
  World world = emptyWorld();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(world.push(0, 10 * i, at(0)).ok());
    ASSERT_TRUE(world.push(1, 10 * i, at(2.0 - 0.2 * i)).ok());
  }
  const WorldContacts before = answerOf(world, 45, 90);
  world.forgetBefore(45);
  const WorldContacts after = answerOf(world, 45, 90);
  ASSERT_EQ(before.contacts.size(), 1u);
  ASSERT_EQ(after.contacts.size(), 1u);
  EXPECT_TRUE(before.contacts[0].time == after.contacts[0].time);
  Scratch scratch;
  WorldContacts answer;
  expectError(world.contacts(40, 90, scratch, answer), ErrorCode::OutOfRange, "forgotten");
}

/// Everything an answer says, to the bit.
std::vector<double> bitsOf(const WorldContacts& answer) {
  std::vector<double> bits;
  for (const WorldContact& c : answer.contacts) {
    for (const ContactSide* side : {&c.a, &c.b}) {
      bits.insert(bits.end(),
                  {static_cast<double>(side->body), static_cast<double>(side->link),
                   static_cast<double>(side->lss), side->p_W.x(), side->p_W.y(), side->p_W.z()});
    }
    bits.insert(bits.end(), {static_cast<double>(c.time.us), c.time.fraction, c.separation,
                             c.penetration, c.nhat_BA_W.x(), c.nhat_BA_W.y(), c.nhat_BA_W.z()});
  }
  return bits;
}

// Poses that arrive in another order among bodies, and windows asked before, change no bit.
TEST(World, AnswersFromPosesAlone) {
  std::vector<double> first;
  for (int order = 0; order < 4; ++order) {
    World world = emptyWorld();
    const Avatar avatar = ball(0.1);
    for (int i = 0; i < 12; ++i) ASSERT_TRUE(world.add(avatar).ok());
    const auto pose = [](int body, int k) {
      test::Random random(static_cast<std::uint64_t>(100 * body + k));
      return RigidPose{random.rotation(), random.inBox(0.6)};
    };
    for (int i = 0; i < 12 * 8; ++i) {
      const int body = order % 2 == 0 ? i % 12 : i / 8, k = order % 2 == 0 ? i / 12 : i % 8;
      ASSERT_TRUE(world.push(body, (1000 + 7 * body) * k, pose(body, k)).ok());
    }
    Scratch scratch;
    WorldContacts answer;
    if (order >= 2) {
      for (const std::int64_t from : {4000, 0, 2000}) {
        ASSERT_TRUE(world.contacts(from, from + 1500, scratch, answer).ok());
      }
    }
    ASSERT_TRUE(world.contacts(500, 6500, scratch, answer).ok());
    EXPECT_GT(answer.contacts.size(), 20u);
    if (order == 0) first = bitsOf(answer);
    EXPECT_EQ(bitsOf(answer), first);
  }
}

// Far from the origin doubles do not resolve what lies between knots finely enough: nothing is
// claimed, and that is said.
TEST(World, IsUndecidedWhereDoublesCannotTell) {
  World world = World::build(std::nullopt, {kMinWorldTolerance}).value();
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  ASSERT_TRUE(world.add(ball(0.1)).ok());
  for (const int i : {0, 1, 2, 3}) {
    ASSERT_TRUE(world.push(0, 10 * i, at(9e6 + i)).ok());
    ASSERT_TRUE(world.push(1, 7 * i, at(9e6 + 1 + i)).ok());
  }
  const WorldContacts answer = answerOf(world, 0, 20);
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].verdict, Verdict::Undecided);
  EXPECT_EQ(answer.contacts[0].reason, UndecidedReason::Resolution);
  EXPECT_EQ(answer.contacts[0].a.link, kEveryLink);
  EXPECT_EQ(answer.contacts[0].time.us, 0);
}

// A thousand bodies in one place are answered.
TEST(World, AnswersACrowdInOnePlace) {
  World world = emptyWorld();
  const Avatar avatar = ball(0.1);
  constexpr int kBodies = 200;
  for (BodyId body = 0; body < kBodies; ++body) {
    ASSERT_TRUE(world.add(avatar).ok());
    ASSERT_TRUE(world.push(body, 0, at(0)).ok());
    ASSERT_TRUE(world.push(body, 10, at(0.1)).ok());
  }
  const WorldContacts answer = answerOf(world, 0, 10);
  EXPECT_EQ(answer.contacts.size(), countOf(kBodies * (kBodies - 1) / 2));
}

TEST(WorldTime, IsNeverLaterThanItsInstant) {
  for (int i = 0; i < 2000; ++i) {
    test::Random random(static_cast<std::uint64_t>(i));
    const std::int64_t begin = random.below(1'000'000) - 500'000;
    const std::int64_t length = 1 + random.below(1'000'000'000);
    const double t = random.chance(0.1) ? 0.0 : random.magnitude(1e-12, 1.0);
    const WorldTime time = worldTimeAt(begin, begin + length, t);
    const long double exact = static_cast<long double>(t) * static_cast<long double>(length);
    const long double got =
        static_cast<long double>(time.us - begin) + static_cast<long double>(time.fraction);
    EXPECT_LE(got, exact);
    EXPECT_GE(got, exact * (1.0L - 1e-15L));
    EXPECT_GE(time.fraction, 0.0);
    EXPECT_LT(time.fraction, 1.0);
  }
  EXPECT_TRUE(worldTimeAt(5, 9, 1.0) == (WorldTime{9, 0.0}));
}

TEST(WorldTime, TheNextInstantIsLaterAndAnInstant) {
  for (const double fraction : {0.0, 0.25, 0.5, std::nextafter(1.0, 0.0)}) {
    const WorldTime time{7, fraction}, next = justAfter(time);
    EXPECT_TRUE(time < next);
    EXPECT_LT(next.fraction, 1.0);
    EXPECT_LE(microsecondsAfter(7, next), fraction + 1e-15);
  }
}

}  // namespace
}  // namespace foretouch
