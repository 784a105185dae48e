// Questions whose answers are known, and what is refused or unknown.
#include "middleware/ask/ask.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/middleware/ask/asked.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::ask;
using test::errorOf;

Avatar rod() {
  RawSkeleton raw;
  raw.joints = {{"rod", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const std::vector<std::vector<Lss>> lss = {{{Vector3d::Zero(), Vector3d(0, 1, 0), 0.1}}};
  return Avatar::build(Skeleton::build(raw).value(), lss).value();
}

/// Two walls of two triangles each, which share an edge, at z = 0 and z = -1.
Scene walls() {
  RawScene raw;
  raw.objectNames = {"near", "far"};
  for (int i = 0; i < 2; ++i) {
    const double z = -i;
    const Vector3d a(-1, -1, z), b(1, -1, z), c(1, 1, z), d(-1, 1, z);
    raw.triangles.push_back({{a, b, c}});
    raw.triangles.push_back({{a, c, d}});
    raw.objectOf.insert(raw.objectOf.end(), {i, i});
  }
  return Scene::build(std::move(raw)).value();
}

TEST(Ask, ARayTellsWhatWhereAndHowFar) {
  const World world = World::build(walls()).value();
  WorldQuestion ray = WorldQuestion::ray(Vector3d(0.25, 0.5, 3), Vector3d(0, 0, -7), 10, {});
  const WorldAnswer first = ask(world, ray);
  ASSERT_EQ(first.hits.size(), 1U);
  const WorldHit& hit = first.hits.front();
  EXPECT_NEAR(hit.distance, 3.0, 1e-9);
  EXPECT_LE(hit.distance, 3.0);
  EXPECT_EQ(hit.what.body, kStillScene);
  EXPECT_EQ(hit.object, 0);
  EXPECT_EQ(hit.what.triangle, 1);
  EXPECT_TRUE(hit.what.p_W.isApprox(Vector3d(0.25, 0.5, 0)));
  EXPECT_TRUE(hit.nhat_W.isApprox(Vector3d(0, 0, 1)));
  EXPECT_EQ(first.verdict(), AskVerdict::Hit);

  ray.which = AskWhich::All;
  const WorldAnswer all = ask(world, ray);
  ASSERT_EQ(all.hits.size(), 2U);
  EXPECT_NEAR(all.hits[1].distance, 4.0, 1e-9);
  EXPECT_EQ(all.hits[1].object, 1);

  ray.without = {{kStillScene, kEveryLink, 0}};
  EXPECT_EQ(ask(world, ray).hits.front().object, 1);
  ray.reach = 2.5;
  EXPECT_EQ(ask(world, ray).verdict(), AskVerdict::Clear);
}

// Along an edge that two triangles share, and through its ends: as computed on either side, such a
// ray may be a little beside both.
TEST(Ask, NoRayPassesBetweenTwoTrianglesThatShareAnEdge) {
  const World world = World::build(walls()).value();
  Scratch scratch;
  WorldAnswer answer;
  for (int i = 0; i <= 2000; ++i) {
    const double s = -1.0 + i * 1e-3;
    const Vector3d on(s, s, 0);
    const Vector3d from(0.3 * std::sin(i), 0.7 * std::cos(3.0 * i), 2.0 + std::sin(7.0 * i));
    const WorldQuestion ray = WorldQuestion::ray(from, on - from, 100.0, {});
    ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
    ASSERT_FALSE(answer.hits.empty()) << i;
    ASSERT_NEAR(answer.hits.front().distance, (on - from).norm(), 1e-8);
  }
}

// Far from the origin doubles resolve a tenth of a nanometre: hits are earlier by it, and none is
// missed.
TEST(Ask, FarAwayNothingIsMissedEither) {
  const Vector3d far(1e6, -2e6, 5e5);
  RawScene raw;
  raw.objectNames = {"wall"};
  const Vector3d a = far + Vector3d(-1, -1, 0), b = far + Vector3d(1, -1, 0),
                 c = far + Vector3d(1, 1, 0), d = far + Vector3d(-1, 1, 0);
  raw.triangles = {{{a, b, c}}, {{a, c, d}}};
  raw.objectOf = {0, 0};
  World world = World::build(Scene::build(std::move(raw)).value()).value();
  const BodyId body = world.add(rod()).value();
  ASSERT_TRUE(world.push(body, 0, RigidPose{Quaternion::Identity(), far + Vector3d(3, 0, 0)}).ok());
  for (int i = 0; i < 500; ++i) {
    const double s = -0.999 + i * 4e-3;
    const Vector3d from = far + Vector3d(0.3 * std::sin(i), 0.5, 2.0);
    const Vector3d onEdge = far + Vector3d(s, s, 0.0), onAxis = far + Vector3d(3, 0.5, 0);
    const WorldAnswer edge = ask(world, WorldQuestion::ray(from, onEdge - from, 100.0, {}));
    ASSERT_FALSE(edge.hits.empty()) << i;
    EXPECT_NEAR(edge.hits.front().distance, (onEdge - from).norm(), 1e-6);
    const WorldAnswer rod = ask(world, WorldQuestion::ray(from, onAxis - from, 100.0, {}));
    ASSERT_FALSE(rod.hits.empty()) << i;
    EXPECT_EQ(rod.hits.front().what.body, body);
    EXPECT_LT(rod.hits.front().distance, (onAxis - from).norm() - 0.09);
  }
}

// Beside an edge of a kilometre, in its triangle's plane: the nearest points tell where to, but to
// so few digits that a plane across their difference cuts the edge.
TEST(Ask, BesideALongEdgeNothingIsHitThatIsNotTouched) {
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Eigen::Matrix3d R = random.rotation().toRotationMatrix();
    const Vector3d along = R.col(0), outward = R.col(1);
    const double gap = random.magnitude(1e-7, 1e-3);
    const Vector3d corners[3] = {-500.0 * along, 500.0 * along, -300.0 * outward};
    RawScene raw;
    raw.objectNames = {"flag"};
    raw.triangles = {{{corners[i % 3], corners[(i + 1) % 3], corners[(i + 2) % 3]}}};
    raw.objectOf = {0};
    const World world = World::build(Scene::build(std::move(raw)).value()).value();
    const Vector3d beside = gap * outward + random.uniform(-400.0, 400.0) * along;
    WorldQuestion question;
    question.what = AskWhat::Nearest;
    question.shape = {beside, beside, 0.0};
    question.reach = gap - 1e-9;
    EXPECT_EQ(ask(world, question).verdict(), AskVerdict::Clear);
    question.reach = gap + 1e-9;
    EXPECT_EQ(ask(world, question).verdict(), AskVerdict::Hit);
  }
}

// Halfway between two poses the rod is where its motion has it, turned by half: neither at one of
// the poses, nor on the chord between.
TEST(Ask, BetweenPosesABodyIsWhereItsMotionHasIt) {
  World world = World::build(std::nullopt).value();
  const BodyId body = world.add(rod()).value();
  const double half = std::sqrt(0.5);
  ASSERT_TRUE(world.push(body, 0, RigidPose{Quaternion::Identity(), Vector3d::Zero()}).ok());
  // A quarter turn about z, from +y to -x.
  ASSERT_TRUE(world.push(body, 1000, RigidPose{{half, 0, 0, half}, Vector3d::Zero()}).ok());
  const Vector3d tip(-half, half, 0);
  const auto rayAt = [&](std::int64_t us, double fraction) {
    return ask(world, WorldQuestion::ray(0.95 * tip + Vector3d(0, 0, 2), Vector3d(0, 0, -1), 9,
                                         {us, fraction}));
  };
  EXPECT_TRUE(rayAt(0, 0.0).hits.empty());
  EXPECT_TRUE(rayAt(1000, 0.0).hits.empty());
  const WorldAnswer between = rayAt(500, 0.0);
  ASSERT_EQ(between.hits.size(), 1U);
  EXPECT_NEAR(between.hits.front().distance, 1.9, 1e-9);
  EXPECT_EQ(between.hits.front().what.lss, 0);
  // The same question of one body at an instant of its own.
  WorldQuestion late =
      WorldQuestion::ray(0.95 * tip + Vector3d(0, 0, 2), Vector3d(0, 0, -1), 9, {1000, 0.0});
  EXPECT_TRUE(ask(world, late).hits.empty());
  late.instants = {{body, {500, 0.0}}};
  EXPECT_EQ(ask(world, late).hits.size(), 1U);
}

// What is kept of an instant must not outlive a change of the world.
TEST(Ask, AChangeOfTheWorldIsSeen) {
  World world = World::build(std::nullopt).value();
  BodyOptions holds;
  holds.whenSilent = WhenSilent::HoldStill;
  const BodyId body = world.add(rod(), holds).value();
  ASSERT_TRUE(world.push(body, 0, RigidPose{}).ok());
  Scratch scratch;
  WorldAnswer answer;
  const auto ray = WorldQuestion::ray(Vector3d(-3, 0.5, 0), Vector3d(1, 0, 0), 9, {500, 0.0});
  ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
  ASSERT_EQ(answer.hits.size(), 1U);
  EXPECT_TRUE(answer.hits.front().isAssumed);
  ASSERT_EQ(answer.unknown.size(), 1U);
  EXPECT_EQ(answer.unknown.front().why, AskUnknown::Assumed);
  EXPECT_TRUE(answer.isComplete());
  ASSERT_TRUE(world.push(body, 1000, RigidPose{Quaternion::Identity(), Vector3d(0, 0, 4)}).ok());
  ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
  EXPECT_TRUE(answer.hits.empty());
  EXPECT_TRUE(answer.unknown.empty());
  const BodyId other = world.add(rod()).value();
  ASSERT_TRUE(world.push(other, 0, RigidPose{}).ok());
  ASSERT_TRUE(world.push(other, 1000, RigidPose{}).ok());
  ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
  ASSERT_EQ(answer.hits.size(), 1U);
  EXPECT_EQ(answer.hits.front().what.body, other);
  EXPECT_NEAR(answer.hits.front().distance, 2.9, 1e-9);
}

TEST(Ask, WhatIsUnknownIsNeverAMiss) {
  World world = World::build(std::nullopt).value();
  const BodyId waits = world.add(rod()).value(), later = world.add(rod()).value();
  ASSERT_TRUE(world.push(waits, 0, RigidPose{}).ok());
  ASSERT_TRUE(world.push(later, 900, RigidPose{}).ok());
  WorldQuestion ray = WorldQuestion::ray(Vector3d(0, 5, 0), Vector3d(0, 1, 0), 9, {500, 0.0});
  const WorldAnswer answer = ask(world, ray);
  EXPECT_EQ(answer.verdict(), AskVerdict::Unknown);
  EXPECT_FALSE(answer.isComplete());
  ASSERT_EQ(answer.unknown.size(), 2U);
  EXPECT_EQ(answer.unknown[0].why, AskUnknown::Silent);
  EXPECT_EQ(answer.unknown[1].why, AskUnknown::NotThere);
  ray.without = {{waits}, {later}};
  EXPECT_EQ(ask(world, ray).verdict(), AskVerdict::Clear);
}

TEST(Ask, OverlapsAndTheNearest) {
  World world = World::build(walls()).value();
  const BodyId body = world.add(rod()).value();
  ASSERT_TRUE(world.push(body, 0, RigidPose{Quaternion::Identity(), Vector3d(0, 0, 0.5)}).ok());
  const Lss ball{Vector3d(0, 0.5, 0.2), Vector3d(0, 0.5, 0.2), 0.15};
  const WorldAnswer clear = ask(world, WorldQuestion::overlap(ball, {}));
  EXPECT_EQ(clear.verdict(), AskVerdict::Clear);
  WorldQuestion near = WorldQuestion::nearest(ball, 1.0, {});
  const WorldAnswer nearest = ask(world, near);
  ASSERT_EQ(nearest.hits.size(), 1U);
  EXPECT_NEAR(nearest.hits.front().distance, 0.05, 1e-12);
  near.which = AskWhich::All;
  EXPECT_EQ(ask(world, near).hits.size(), 3U);  // the rod, and two triangles of the near wall
  near.which = AskWhich::Closest;
  near.reach = 0.04;
  EXPECT_EQ(ask(world, near).verdict(), AskVerdict::Clear);
  const Lss wide{ball.a, ball.b, 0.25};
  EXPECT_EQ(ask(world, WorldQuestion::overlap(wide, {})).hits.size(), 2U);
}

TEST(Ask, RefusesByName) {
  World world = World::build(walls()).value();
  const BodyId body = world.add(rod()).value();
  ASSERT_TRUE(world.push(body, 0, RigidPose{}).ok());
  ASSERT_TRUE(world.push(body, 1000, RigidPose{}).ok());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const WorldQuestion good = WorldQuestion::ray(Vector3d(0, 0, 3), Vector3d(0, 0, -1), 9, {});
  const auto with = [&](auto change) {
    WorldQuestion question = good;
    change(question);
    return errorOf(world, question);
  };
  EXPECT_EQ(errorOf(world, good), "");
  using Q = WorldQuestion;
  EXPECT_NE(with([&](Q& q) { q.direction.setZero(); }).find("found zero"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.direction.x() = nan; }).find("direction"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.direction.x() = infinite; }).find("direction"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.shape.a.x() = nan; }).find("shape"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.shape.b.x() = 1e8; }).find("1e7"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.shape.radius = -1e-9; }).find("radius"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.reach = infinite; }).find("finite reach"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.reach = 0.0; }).find("reach"), std::string::npos);
  EXPECT_EQ(with([&](Q& q) { q.reach = kMostAskReach; }), "");
  const double tooFar = std::nextafter(kMostAskReach, infinite);
  EXPECT_NE(with([&](Q& q) { q.reach = tooFar; }).find("1e8"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.time.fraction = 1.0; }).find("fraction"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.without = {{7}}; }).find("body 7"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.only = {{body, 3}}; }).find("found 3"), std::string::npos);
  EXPECT_NE(with([&](Q& q) { q.instants = {{-1, {}}}; }).find("instants"), std::string::npos);
  world.forgetBefore(500);
  EXPECT_NE(errorOf(world, good).find("forgotten"), std::string::npos);
  EXPECT_EQ(with([&](Q& q) { q.time.us = 500; }), "");
  // Directions of any size are directions.
  EXPECT_EQ(with([&](Q& q) {
              q.time.us = 500;
              q.direction = Vector3d(0, 0, -1e-300);
            }),
            "");
  const auto fly = [&](const Vector3d& way, std::int64_t toUs) {
    FlightQuestion flight;
    flight.way = way;
    flight.fromUs = 500;
    flight.toUs = toUs;
    Scratch scratch;
    FlightAnswer answer;
    const auto done = askFlight(world, flight, scratch, answer);
    return done.ok() ? std::string() : describe(done.error());
  };
  EXPECT_EQ(fly(Vector3d::UnitX(), 900), "");
  EXPECT_EQ(fly(Vector3d(nan, 0, 0), 900), "way: expected finite numbers");
  EXPECT_EQ(fly(Vector3d(0, infinite, 0), 900), "way: expected finite numbers");
  EXPECT_NE(fly(Vector3d(1e8, 0, 0), 900).find("1e7"), std::string::npos);
  EXPECT_NE(fly(Vector3d::UnitX(), 500).find("to_us"), std::string::npos);
}

// A body that comes in a flight's time and is silent before its end: both are told, each once.
TEST(Ask, AFlightTellsEachReasonWhyABodyIsUnknown) {
  World world = World::build(std::nullopt).value();
  BodyOptions undecided;
  undecided.whenSilent = WhenSilent::Undecided;
  const BodyId carrier = world.add(rod(), undecided).value(), clock = world.add(rod()).value();
  const BodyId carried = world.add(rod()).value();
  const auto far = [](double y) { return RigidPose{Quaternion::Identity(), Vector3d(0, y, 90)}; };
  for (int i = 0; i <= 5; ++i) ASSERT_TRUE(world.push(clock, 10'000 * i, far(0)).ok());
  for (const int i : {1, 2}) ASSERT_TRUE(world.push(carrier, 10'000 * i, far(5)).ok());
  ASSERT_TRUE(world.attach(carried, {carrier, 0, false}, 10'000, far(0)).ok());
  ASSERT_TRUE(world.push(carrier, 30'000, far(5)).ok());
  FlightQuestion flight;
  flight.shape = {Vector3d(0, 500, 0), Vector3d(0, 500, 0), 0.1};
  flight.way = Vector3d(1, 0, 0);
  flight.toUs = 50'000;
  Scratch scratch;
  FlightAnswer flown;
  ASSERT_TRUE(askFlight(world, flight, scratch, flown).ok());
  std::string all;
  for (const UnknownBody& body : flown.unknown) {
    all += std::to_string(body.body) + (body.why == AskUnknown::NotThere ? " absent, "
                                        : body.why == AskUnknown::Silent ? " silent, "
                                                                         : " other, ");
  }
  EXPECT_EQ(all, "0 absent, 0 silent, 2 absent, 2 silent, ");
}

// A flight keeps a body's boxes piece after piece, and has more pieces than are kept.
TEST(Ask, AFlightThroughManyPosesLeavesTheNextQuestionItsHit) {
  World world = World::build(std::nullopt).value();
  const BodyId body = world.add(rod()).value();
  for (int i = 0; i <= 70; ++i) {
    const RigidPose pose{Quaternion::Identity(), Vector3d(i, 0, 0)};
    ASSERT_TRUE(world.push(body, 10'000 * i, pose).ok());
  }
  const WorldQuestion ray =
      WorldQuestion::ray(Vector3d(0.5, 0.5, 3), Vector3d(0, 0, -1), 10, {5'000, 0.0});
  Scratch scratch;
  WorldAnswer answer;
  ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
  ASSERT_EQ(answer.hits.size(), 1U);
  const double distance = answer.hits[0].distance;
  FlightQuestion flight;
  flight.shape = {Vector3d(0, 500, 0), Vector3d(0, 500, 0), 0.1};
  flight.way = Vector3d(1, 0, 0);
  flight.toUs = 700'000;
  FlightAnswer flown;
  ASSERT_TRUE(askFlight(world, flight, scratch, flown).ok());
  ASSERT_TRUE(askWorld(world, ray, scratch, answer).ok());
  ASSERT_EQ(answer.hits.size(), 1U);
  EXPECT_EQ(answer.hits[0].distance, distance);
}

}  // namespace
}  // namespace foretouch
