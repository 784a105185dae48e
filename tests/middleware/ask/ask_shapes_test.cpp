// Boxes and other convex solids, what a point is inside of, and many questions in one call: answers
// that plain arithmetic knows, and what is refused.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/ask/ask.h"
#include "tests/middleware/ask/asked.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::ask;
using test::errorOf;

/// A closed box of twelve triangles, a pyramid without its base.
RawScene boxAndPyramid(double half) {
  const std::vector<Vector3d> v = boxCorners(Vector3d::Constant(half));
  const int faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                            {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  RawScene raw;
  raw.objectNames = {"box", "pyramid"};
  for (const auto& [a, b, c] : faces) {
    raw.triangles.push_back({{v[static_cast<std::size_t>(a)], v[static_cast<std::size_t>(b)],
                              v[static_cast<std::size_t>(c)]}});
    raw.objectOf.push_back(0);
  }
  const Vector3d top(10, 1, 0), a(9, 0, -1), b(11, 0, -1), c(10, 0, 1);
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    raw.triangles.push_back({{p, q, top}});
    raw.objectOf.push_back(1);
  }
  return raw;
}

World boxWorld() {
  return World::build(Scene::build(boxAndPyramid(1.0)).value()).value();
}

WorldQuestion boxAt(const Vector3d& place, double half, const Quaternion& axes) {
  WorldQuestion question;
  question.shape = {place, place, 0.0};
  question.hull = boxCorners(Vector3d::Constant(half), axes);
  return question;
}

TEST(AskShapes, ABoxIsCastOverlapsAndIsNear) {
  const World world = boxWorld();
  WorldQuestion box = boxAt(Vector3d(-5, 0.25, 0.125), 0.5, Quaternion::Identity());
  box.direction = Vector3d(3, 0, 0);
  box.reach = 10.0;
  const WorldAnswer flat = ask(world, box);
  ASSERT_EQ(flat.hits.size(), 1U);
  EXPECT_NEAR(flat.hits[0].distance, 3.5, 2e-9);
  EXPECT_LE(flat.hits[0].distance, 3.5);
  EXPECT_TRUE(flat.hits[0].nhat_W.isApprox(Vector3d(-1, 0, 0), 1e-5));
  EXPECT_NEAR(flat.hits[0].what.p_W.x(), -1.0, 1e-8);
  // On its edge.
  const double half = std::sqrt(0.5);
  box.hull = boxCorners(Vector3d::Constant(0.5), {std::cos(M_PI / 8), 0, 0, std::sin(M_PI / 8)});
  EXPECT_NEAR(ask(world, box).hits.at(0).distance, 4.0 - half, 2e-9);
  box.shape.radius = 0.25;
  EXPECT_NEAR(ask(world, box).hits.at(0).distance, 3.75 - half, 2e-9);
  box.shape.radius = 0.0;
  box.what = AskWhat::Nearest;
  EXPECT_NEAR(ask(world, box).hits.at(0).distance, 4.0 - half, 2e-9);
  box.reach = 3.0;
  EXPECT_EQ(ask(world, box).verdict(), AskVerdict::Clear);
  box.what = AskWhat::Overlap;
  EXPECT_EQ(ask(world, box).verdict(), AskVerdict::Clear);
  // It passes beside by a micrometre, and does not by one less.
  box = boxAt(Vector3d(-5, 1.5 + 1e-6, 0), 0.5, Quaternion::Identity());
  box.direction = Vector3d::UnitX();
  box.reach = 10.0;
  EXPECT_EQ(ask(world, box).verdict(), AskVerdict::Clear);
  box.shape.a.y() = box.shape.b.y() = 1.5 - 1e-6;
  EXPECT_EQ(ask(world, box).verdict(), AskVerdict::Hit);
}

TEST(AskShapes, WhatIsWithinAHullTouchesIt) {
  World world = World::build(std::nullopt).value();
  RawSkeleton raw;
  raw.joints = {{"ball", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
  const std::vector<std::vector<Lss>> lss = {{{Vector3d::Zero(), Vector3d::Zero(), 0.1}}};
  const BodyId body = world.add(Avatar::build(Skeleton::build(raw).value(), lss).value()).value();
  ASSERT_TRUE(world.push(body, 0, RigidPose{}).ok());
  WorldQuestion box = boxAt(Vector3d(1, 1, 1), 5.0, Quaternion::Identity());
  box.what = AskWhat::Overlap;
  ASSERT_EQ(ask(world, box).hits.size(), 1U);
  EXPECT_EQ(ask(world, box).hits[0].distance, 0.0);
  box.what = AskWhat::Cast;
  box.direction = Vector3d::UnitX();
  box.reach = 1.0;
  EXPECT_EQ(ask(world, box).hits.at(0).distance, 0.0);
}

// A hull of a segment's ends is the segment; far away, too.
TEST(AskShapes, AHullOfTwoCornersIsACapsule) {
  const World world = boxWorld();
  test::Random random(5);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = 4.0 * random.inBox(1.0), b = a + random.inBox(1.0);
    WorldQuestion capsule = WorldQuestion::cast({a, b, 0.1}, random.inBox(0.5) - a, 9.0, {});
    WorldQuestion hull = capsule;
    hull.shape.b = a;
    hull.hull = {Vector3d::Zero(), b - a};
    const WorldAnswer x = ask(world, capsule), y = ask(world, hull);
    ASSERT_EQ(x.hits.empty(), y.hits.empty());
    if (x.hits.empty()) continue;
    ++hits;
    EXPECT_NEAR(x.hits[0].distance, y.hits[0].distance, 1e-6);
  }
  EXPECT_GT(hits, 100);
}

TEST(AskShapes, AFlyingBoxHitsWhatComesTowardsIt) {
  World world = World::build(std::nullopt).value();
  const BodyId other = world.add(Scene::build(boxAndPyramid(0.5)).value()).value();
  ASSERT_TRUE(world.push(other, 0, RigidPose{Quaternion::Identity(), Vector3d(4, 0, 0)}).ok());
  ASSERT_TRUE(world.push(other, 1000, RigidPose{Quaternion::Identity(), Vector3d(2, 0, 0)}).ok());
  FlightQuestion flight;
  flight.hull = boxCorners(Vector3d::Constant(0.5));
  flight.way = Vector3d(4, 0, 0);
  flight.toUs = 1000;
  Scratch scratch;
  FlightAnswer answer;
  ASSERT_TRUE(askFlight(world, flight, scratch, answer).ok());
  ASSERT_TRUE(answer.first);
  // Three metres apart, at six per millisecond.
  const double us = static_cast<double>(answer.first->time.us) + answer.first->time.fraction;
  EXPECT_NEAR(us, 500.0, 1e-5);
  EXPECT_LE(us, 500.0);
}

TEST(AskShapes, APointIsInsideOfWhatIsClosed) {
  World world = boxWorld();
  const auto inside = [&](const Vector3d& p) { return ask(world, WorldQuestion::inside(p, {})); };
  const WorldAnswer middle = inside(Vector3d(0.3, 0.2, 0.1));
  ASSERT_EQ(middle.hits.size(), 1U);
  EXPECT_EQ(middle.hits[0].object, 0);
  EXPECT_EQ(middle.hits[0].what.triangle, -1);
  EXPECT_EQ(middle.hits[0].what.lss, -1);
  EXPECT_EQ(middle.hits[0].distance, 0.0);
  EXPECT_EQ(middle.hits[0].what.p_W, Vector3d(0.3, 0.2, 0.1));
  EXPECT_TRUE(middle.isComplete());
  EXPECT_EQ(inside(Vector3d(1 + 1e-9, 0, 0)).verdict(), AskVerdict::Clear);
  EXPECT_EQ(inside(Vector3d(1 - 1e-9, 0.1, 0.2)).hits[0].what.triangle, -1);
  // Surfaces count, unless it is asked otherwise.
  const Lss ball{Vector3d::Zero(), Vector3d::Zero(), 0.5};
  WorldQuestion overlap = WorldQuestion::overlap(ball, {});
  EXPECT_EQ(ask(world, overlap).verdict(), AskVerdict::Clear);
  overlap.solids = true;
  EXPECT_EQ(ask(world, overlap).verdict(), AskVerdict::Hit);
  WorldQuestion ray = WorldQuestion::ray(Vector3d::Zero(), Vector3d::UnitX(), 5.0, {});
  EXPECT_NEAR(ask(world, ray).hits.at(0).distance, 1.0, 1e-9);
  ray.solids = true;
  EXPECT_EQ(ask(world, ray).hits.at(0).distance, 0.0);
  ray.without = {{kStillScene, kEveryLink, 0}};
  EXPECT_EQ(ask(world, ray).verdict(), AskVerdict::Clear);
}

TEST(AskShapes, WhatIsNotClosedIsUnknownInItsBoxAndNowhereElse) {
  World world = boxWorld();
  const BodyId body = world.add(Scene::build(boxAndPyramid(1.0)).value()).value();
  const RigidPose pose{{std::sqrt(0.5), 0, std::sqrt(0.5), 0}, Vector3d(0, 20, 0)};
  ASSERT_TRUE(world.push(body, 0, pose).ok());
  const WorldAnswer open = ask(world, WorldQuestion::inside(Vector3d(10, 0.5, 0), {}));
  EXPECT_EQ(open.verdict(), AskVerdict::Unknown);
  ASSERT_EQ(open.unknown.size(), 1U);
  EXPECT_EQ(open.unknown[0].body, kStillScene);
  EXPECT_EQ(open.unknown[0].why, AskUnknown::Open);
  EXPECT_EQ(open.unknown[0].object, 1);
  EXPECT_EQ(ask(world, WorldQuestion::inside(Vector3d(10, 1.5, 0), {})).verdict(),
            AskVerdict::Clear);
  // Of a body, where its pose has it.
  const auto placed = [&](const Vector3d& p) {
    return Vector3d(pose.rotation * p + pose.translation);
  };
  const WorldAnswer moved = ask(world, WorldQuestion::inside(placed(Vector3d(10, 0.5, 0)), {}));
  ASSERT_EQ(moved.unknown.size(), 1U);
  EXPECT_EQ(moved.unknown[0].body, body);
  const WorldAnswer within = ask(world, WorldQuestion::inside(placed(Vector3d(0.5, 0, 0)), {}));
  ASSERT_EQ(within.hits.size(), 1U);
  EXPECT_EQ(within.hits[0].what.body, body);
}

// Its LSS are around its faces alone: the middle is in none of them.
TEST(AskShapes, ALinkIsSolidIfItsTrianglesAreClosed) {
  for (const bool isClosed : {true, false}) {
    RawSkeleton raw;
    raw.joints = {{"hollow", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
    std::vector<Lss> lss;
    std::vector<Triangle> triangles = boxAndPyramid(1.0).triangles;
    triangles.resize(isClosed ? 12 : 11);
    for (const Triangle& triangle : triangles) {
      const auto& v = triangle.vertices;
      lss.push_back({v[0], v[1], (v[2] - v[0]).norm() + 1e-6});
    }
    const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {lss}).value();
    BodyOptions options;
    options.surface = AvatarSurface::build(avatar, {triangles}).value();
    World world = World::build(std::nullopt).value();
    const BodyId body = world.add(avatar, options).value();
    ASSERT_TRUE(world.push(body, 0, RigidPose{}).ok());
    const WorldAnswer answer = ask(world, WorldQuestion::inside(Vector3d(0.1, 0.2, 0.3), {}));
    if (isClosed) {
      ASSERT_EQ(answer.hits.size(), 1U);
      EXPECT_EQ(answer.hits[0].what.body, body);
      EXPECT_EQ(answer.hits[0].what.triangle, -1);
    } else {
      EXPECT_EQ(answer.verdict(), AskVerdict::Unknown);
      EXPECT_EQ(answer.unknown.at(0).why, AskUnknown::Open);
    }
    EXPECT_EQ(ask(world, WorldQuestion::inside(Vector3d(1.5, 0, 0), {})).verdict(),
              AskVerdict::Clear);
  }
}

TEST(AskShapes, RefusesByName) {
  const World world = boxWorld();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [&](auto change) {
    WorldQuestion question = boxAt(Vector3d::Zero(), 0.5, Quaternion::Identity());
    question.what = AskWhat::Overlap;
    change(question);
    return errorOf(world, question);
  };
  using Q = WorldQuestion;
  EXPECT_EQ(with([](Q&) {}), "");
  EXPECT_NE(with([&](Q& q) { q.hull[3].y() = nan; }).find("hull: corner 3"), std::string::npos)
      << with([&](Q& q) { q.hull[3].y() = nan; });
  EXPECT_NE(with([](Q& q) { q.hull[2].y() = 2e7; }).find("1e7"), std::string::npos);
  EXPECT_NE(with([](Q& q) { q.shape.b.x() = 1.0; }).find("both ends alike"), std::string::npos);
  EXPECT_EQ(with([](Q& q) { q.hull.resize(kMostCorners, Vector3d::Zero()); }), "");
  EXPECT_NE(with([](Q& q) { q.hull.resize(kMostCorners + 1, Vector3d::Zero()); }).find("1024"),
            std::string::npos);
}

TEST(AskShapes, ManyQuestionsInOneCallNameTheOneThatIsWrong) {
  const World world = boxWorld();
  std::vector<WorldQuestion> questions(
      5, WorldQuestion::ray(Vector3d(-5, 0, 0), Vector3d::UnitX(), 9.0, {}));
  questions[1].time.us = 7;
  questions[2].shape.a.y() = questions[2].shape.b.y() = 5.0;
  Scratch scratch;
  std::vector<WorldAnswer> answers;
  ASSERT_TRUE(askWorld(world, questions, scratch, answers).ok());
  ASSERT_EQ(answers.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(answers[i].hits.empty(), i == 2) << i;
  questions[3].direction.setZero();
  const auto refused = askWorld(world, questions, scratch, answers);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().index, 3);
  EXPECT_NE(describe(refused.error()).find("question 3"), std::string::npos);
}

}  // namespace
}  // namespace foretouch
