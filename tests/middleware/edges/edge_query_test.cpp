// Edges by joint angles, held against closed forms and the judge's distance: neither shares code
// with the query.
#include "middleware/edges/edge_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "tests/middleware/edges/arm_among_wires.h"

namespace foretouch {
namespace {

using test::arm;
using test::kPi;
using test::Place;
using test::wires;

/// At one instant of an edge.
double separationAt(const oracle::Scene& scene, const std::vector<double>& q0,
                    const std::vector<double>& q1, double t) {
  std::vector<double> q;
  for (std::size_t i = 0; i < q0.size(); ++i) q.push_back(q0[i] + t * (q1[i] - q0[i]));
  return test::separationOf(scene, q);
}

TEST(EdgeQuery, TurnsTheLongWayBeyondAHalfTurn) {
  const Robot robot = arm();
  const Place place = wires({{-1.0, 0.0}});
  const auto edges = EdgeQuery::build(robot, place.scene).value();
  Scratch scratch;
  // From 0.5 to 2 pi - 0.5 the arm passes the wire at pi; on the shorter arc it would not.
  const auto met = edges.answer({0.5, 0, 0}, {2 * kPi - 0.5, 0, 0}, scratch).value();
  EXPECT_EQ(met.verdict, Verdict::Contact);
  const double touch = kPi - std::asin(0.03 / 1.0), turn = 2 * kPi - 1.0;
  EXPECT_LE(met.freeUntil, (touch - 0.5) / turn);
  EXPECT_GT(met.freeUntil, (touch - 0.5) / turn - 0.003);
  EXPECT_EQ(edges.answer({0.5, 0, 0}, {-0.5, 0, 0}, scratch).value().verdict, Verdict::Clear);
}

TEST(EdgeQuery, IsNeverLateAndMissesNothing) {
  const Robot robot = arm();
  const Place place = wires({{0.7, 0.5}, {-0.6, 0.7}, {0.1, -0.9}, {-0.9, -0.3}});
  const auto edges = EdgeQuery::build(robot, place.scene).value();
  Scratch scratch;
  int hits = 0, clear = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> angle(-6.5, 6.5);
    const std::vector<double> q0{angle(random), angle(random) / 3, angle(random) / 3},
        q1{angle(random), angle(random) / 3, angle(random) / 3};
    const auto answer = edges.answer(q0, q1, scratch).value();
    ASSERT_NE(answer.verdict, Verdict::Undecided) << seed;
    const int samples = 2000;
    for (int k = 0; k <= samples; ++k) {
      const double t = static_cast<double>(k) / samples;
      if (t >= answer.freeUntil && answer.verdict != Verdict::Clear) break;
      ASSERT_GT(separationAt(place.judged, q0, q1, t), 0.0) << seed << " at " << t;
    }
    if (answer.verdict == Verdict::Clear) {
      ++clear;
    } else {
      ++hits;
      EXPECT_LE(separationAt(place.judged, q0, q1, answer.freeUntil), 1.001e-3) << seed;
    }
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(clear, 20);
}

TEST(EdgeQuery, ProvesItsClearance) {
  const Robot robot = arm();
  const Place place = wires({{1.25, 0.0}});  // 0.02 m beyond the stretched arm
  Scratch scratch;
  EdgeOptions options;
  options.tolerance = 1e-4;
  const auto verdictAt = [&](double clearance) {
    options.clearance = clearance;
    const auto edges = EdgeQuery::build(robot, place.scene, options).value();
    return edges.answer({-0.5, 0, 0}, {0.5, 0, 0}, scratch).value().verdict;
  };
  EXPECT_EQ(verdictAt(0.0), Verdict::Clear);
  EXPECT_EQ(verdictAt(0.0195), Verdict::Clear);
  EXPECT_EQ(verdictAt(0.0201), Verdict::Contact);
}

TEST(EdgeQuery, AsksOwnLinksAndATool) {
  const Robot robot = arm();
  const Place place = wires({{50.0, 0.0}});
  Scratch scratch;
  EdgeOptions options;
  options.self = PairRules::derive(robot.avatar()).value();
  const auto bare = EdgeQuery::build(robot, place.scene, options).value();
  const auto folded = bare.answer({0, 0, 0}, {0, 2.6, 2.6}, scratch).value();
  EXPECT_EQ(folded.verdict, Verdict::Contact);
  EXPECT_EQ(folded.contact.link, 0);
  EXPECT_EQ(folded.contact.other, 2);
  const auto bent = bare.answer({0, 0, 0}, {0, 1.2, 1.2}, scratch).value();
  EXPECT_EQ(bent.verdict, Verdict::Clear);
  const Robot tooled = robot.withTool(2, "rod", {{{0.4, 0, 0}, {0.8, 0, 0}, 0.01}}).value();
  options.self = PairRules::derive(tooled.avatar()).value();
  const auto armed = EdgeQuery::build(tooled, place.scene, options).value();
  const auto struck = armed.answer({0, 0, 0}, {0, 2.0, 2.2}, scratch).value();
  EXPECT_EQ(struck.verdict, Verdict::Contact);
  EXPECT_EQ(std::max(struck.contact.link, struck.contact.other), 3);
}

/// A bar of its own frame's z axis, tilted by so much against the world's.
RigidPose tiltedAt(double x, double y, double tilt, double about) {
  const Eigen::AngleAxisd first(tilt, Eigen::Vector3d(std::cos(about), std::sin(about), 0.0));
  const Eigen::AngleAxisd second(about, Eigen::Vector3d::UnitZ());
  return {Quaternion(Eigen::Quaterniond(first * second)), Eigen::Vector3d(x, y, 0.0)};
}

std::vector<Triangle> bar() {
  return {Triangle{
      {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.05, 0.02, 1)}}};
}

Scene barScene() {
  RawScene raw;
  raw.objectNames = {"bar"};
  raw.triangles = bar();
  raw.objectOf = {0};
  return Scene::build(raw).value();
}

/// By long doubles and a rotation matrix of its own: nothing of the query's.
oracle::Scene judgedAt(const RigidPose& pose) {
  const long double w = pose.rotation.w(), x = pose.rotation.x(), y = pose.rotation.y(),
                    z = pose.rotation.z();
  const long double m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  std::vector<oracle::Triangle> triangles;
  for (const Triangle& triangle : bar()) {
    std::array<oracle::Vec3d, 3> placed;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& v = triangle.vertices[i];
      double p[3];
      for (int r = 0; r < 3; ++r) {
        p[r] = static_cast<double>(m[r][0] * v.x() + m[r][1] * v.y() + m[r][2] * v.z() +
                                   static_cast<long double>(pose.translation[r]));
      }
      placed[i] = oracle::Vec3d(p[0], p[1], p[2]);
    }
    triangles.push_back({placed[0], placed[1], placed[2]});
  }
  return oracle::Scene(triangles);
}

TEST(EdgeQuery, IsNeverLateAmongPropsThatMove) {
  const Robot robot = arm();
  const Place place = wires({{0.7, 0.5}});
  constexpr std::size_t kProps = 3;
  EdgeOptions options;
  options.clearance = 0.004;
  options.props.assign(kProps, EdgeProp{barScene(), std::nullopt, {}});
  auto edges = EdgeQuery::build(robot, place.scene, options).value();
  Scratch scratch;
  int ofProps = 0, ofScene = 0, clear = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> angle(-6.5, 6.5), where(-1.3, 1.3), tilt(0.0, 1.2);
    std::vector<std::optional<oracle::Scene>> judged{place.judged};
    for (std::size_t i = 0; i < kProps; ++i) {
      std::optional<RigidPose> pose;
      const double x = where(random), y = where(random);
      const bool isThere = i + 1 < kProps || seed % 2 == 0;
      if (isThere && std::hypot(x, y) > 0.3) pose = tiltedAt(x, y, tilt(random), angle(random));
      ASSERT_TRUE(edges.place(i, pose).ok());
      judged.push_back(pose ? std::optional(judgedAt(*pose)) : std::nullopt);
    }
    const std::vector<double> q0{angle(random), angle(random) / 3, angle(random) / 3},
        q1{angle(random), angle(random) / 3, angle(random) / 3};
    const auto answer = edges.answer(q0, q1, scratch).value();
    ASSERT_NE(answer.verdict, Verdict::Undecided);
    const auto gapAt = [&](double t) {
      double least = 1e9;
      for (const auto& scene : judged) {
        if (scene) least = std::min(least, separationAt(*scene, q0, q1, t));
      }
      return least - options.clearance;
    };
    constexpr int kSamples = 2000;
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      if (t >= answer.freeUntil && answer.verdict != Verdict::Clear) break;
      ASSERT_GT(gapAt(t), 0.0) << t;
    }
    if (answer.verdict == Verdict::Clear) {
      ++clear;
      EXPECT_EQ(answer.prop, -1);
      continue;
    }
    EXPECT_LE(gapAt(answer.freeUntil), 1.001e-3);
    ++(answer.prop >= 0 ? ofProps : ofScene);
    // Its own gap is the one that is told, and the points are in the world.
    const auto met = static_cast<std::size_t>(answer.prop + 1);
    EXPECT_LE(separationAt(*judged[met], q0, q1, answer.freeUntil) - options.clearance, 1.001e-3);
    const oracle::Vec3d on(answer.contact.p_WScene);
    EXPECT_LT(oracle::distanceTo(*judged[met], on, on, 1.0), 1e-9);
    if (answer.verdict == Verdict::Contact) {
      const Eigen::Vector3d between = answer.contact.p_WLink - answer.contact.p_WScene;
      EXPECT_NEAR(between.dot(answer.contact.nhat_SL_W), between.norm(), 1e-9);
    }
  }
  EXPECT_GT(ofProps, 100);
  EXPECT_GT(ofScene, 10);
  EXPECT_GT(clear, 20);
}

TEST(EdgeQuery, AnswersAPropAsTheSameTrianglesOfTheScene) {
  const Robot robot = arm();
  RawScene raw;
  raw.objectNames = {"bar"};
  raw.triangles = bar();
  for (Triangle& triangle : raw.triangles) {
    for (Eigen::Vector3d& vertex : triangle.vertices) vertex += Eigen::Vector3d(0.5, 0.5, 0.0);
  }
  raw.objectOf = {0};
  const Place far = wires({{50.0, 0.0}});
  EdgeOptions options;
  options.props = {{barScene(), RigidPose{Quaternion::Identity(), {0.5, 0.5, 0.0}}, {}}};
  const auto still = EdgeQuery::build(robot, Scene::build(raw).value()).value();
  auto posed = EdgeQuery::build(robot, far.scene, options).value();
  const EdgeQuery copy = posed;
  Scratch scratch;
  const std::vector<double> q0{-0.5, 0, 0}, q1{1.5, 0.2, 0};
  const auto one = still.answer(q0, q1, scratch).value(),
             other = posed.answer(q0, q1, scratch).value();
  EXPECT_EQ(one.verdict, Verdict::Contact);
  EXPECT_EQ(other.verdict, Verdict::Contact);
  EXPECT_NEAR(one.freeUntil, other.freeUntil, 1e-6);
  EXPECT_EQ(other.prop, 0);
  EXPECT_EQ(other.contact.other, -1);
  // Of two that are met at once, the first.
  EdgeOptions twice = options;
  twice.props.push_back(twice.props[0]);
  const auto both = EdgeQuery::build(robot, far.scene, twice).value();
  EXPECT_EQ(both.answer(q0, q1, scratch).value().prop, 0);
  // Out of the way, or not there; a copy keeps its own places.
  ASSERT_TRUE(posed.place(0, RigidPose{Quaternion::Identity(), {5.0, 0.0, 0.0}}).ok());
  EXPECT_EQ(posed.answer(q0, q1, scratch).value().verdict, Verdict::Clear);
  ASSERT_TRUE(posed.place(0, std::nullopt).ok());
  EXPECT_EQ(posed.answer(q0, q1, scratch).value().verdict, Verdict::Clear);
  EXPECT_EQ(copy.answer(q0, q1, scratch).value().verdict, Verdict::Contact);
  // What a prop ignores is of that prop.
  options.props[0].ignored = {{1}, {2}};
  const auto ignoring = EdgeQuery::build(robot, far.scene, options).value();
  EXPECT_EQ(ignoring.answer(q0, q1, scratch).value().verdict, Verdict::Clear);
}

TEST(EdgeQuery, RefusesPlacesThatAreNone) {
  EdgeOptions options;
  options.props = {{barScene(), RigidPose{}, {}}};
  const Place far = wires({{50.0, 0.0}});
  auto edges = EdgeQuery::build(arm(), far.scene, options).value();
  EXPECT_EQ(edges.numProps(), 1u);
  EXPECT_EQ(edges.place(1, RigidPose{}).error().code, ErrorCode::OutOfRange);
  const auto refused = [&](const RigidPose& pose) {
    const auto placed = edges.place(0, pose);
    return !placed.ok() && placed.error().index == 0;
  };
  EXPECT_TRUE(refused({Quaternion(2.0, 0.0, 0.0, 0.0), {0.0, 0.0, 0.0}}));
  EXPECT_TRUE(refused({Quaternion::Identity(), {0.0, std::nan(""), 0.0}}));
  EXPECT_TRUE(refused({Quaternion::Identity(), {0.0, 0.0, 1.1e4}}));
  options.props[0].ignored = {{99}};
  const auto built = EdgeQuery::build(arm(), far.scene, options);
  ASSERT_FALSE(built.ok());
  EXPECT_EQ(built.error().index, 0);
}

TEST(EdgeQuery, TellsWhatIsWrongWithQ) {
  const Place place = wires({{-1.0, 0.0}});
  const auto edges = EdgeQuery::build(arm(-2.0, 2.0), place.scene).value();
  Scratch scratch;
  EXPECT_EQ(edges.answer({0, 0}, {0, 0, 0}, scratch).error().code, ErrorCode::Mismatch);
  EXPECT_EQ(edges.answer({0, 0, 0}, {0, 0}, scratch).error().code, ErrorCode::Mismatch);
  EXPECT_EQ(edges.answer({0, std::nan(""), 0}, {0, 0, 0}, scratch).error().index, 1);
  const auto out = edges.answer({0, 0, 0}, {0, 2.5, 0}, scratch).value();
  EXPECT_FALSE(out.isUsable());
  EXPECT_EQ(out.breachAt1.coordinate, 1);
  // A zero-length edge is a question about one configuration.
  EXPECT_EQ(edges.answer({0, 0, 0}, {0, 0, 0}, scratch).value().verdict, Verdict::Clear);
  const auto inside = EdgeQuery::build(arm(), place.scene).value();
  EXPECT_EQ(inside.answer({kPi, 0, 0}, {kPi, 0, 0}, scratch).value().verdict,
            Verdict::StartsInContact);
}

// A joint that a gear turns two thousand times: nothing is claimed of it.
TEST(EdgeQuery, ClaimsNothingOfAnEdgeThatIsTooLong) {
  std::vector<RobotJoint> joints = arm().joints();
  joints[2].mimicOf = 1;
  joints[2].mimicFactor = 125.0;
  joints[2].lower = -RobotJoint::kUnlimited;
  joints[2].upper = RobotJoint::kUnlimited;
  const Robot robot = Robot::build(arm().avatar(), joints).value();
  const std::size_t n = robot.coordinates().size();
  const auto edges = EdgeQuery::build(robot, wires({{50.0, 0.0}}).scene).value();
  Scratch scratch;
  const std::vector<double> home(n, 0.0), near(n, 90.0), far(n, 100.0);
  EXPECT_EQ(edges.answer(home, near, scratch).value().verdict, Verdict::Clear);
  const auto answer = edges.answer(home, far, scratch).value();
  EXPECT_EQ(answer.verdict, Verdict::Undecided);
  EXPECT_EQ(answer.reason, UndecidedReason::Resolution);
  EXPECT_EQ(answer.freeUntil, 0.0);
  EXPECT_EQ(edges.clearance(home.data(), far.data(), n, scratch).error().code,
            ErrorCode::LimitExceeded);
  std::vector<double> all;
  for (const auto* q : {&home, &near, &home, &far}) all.insert(all.end(), q->begin(), q->end());
  const auto path = robot.pathAlong(all.data(), 4);
  ASSERT_FALSE(path.ok());
  EXPECT_EQ(path.error().index, 2) << "the third edge";
}

TEST(EdgeQuery, RefusesRulesOfAnotherAvatar) {
  EdgeOptions options;
  options.self = PairRules::derive(arm().avatar()).value();
  const auto edges = EdgeQuery::build(arm(), wires({{50.0, 0.0}}).scene, options);
  ASSERT_FALSE(edges.ok());
  EXPECT_EQ(edges.error().file, "self");
}

TEST(Robot, RefusesLimitsTheWrongWayRound) {
  const Robot robot = arm();
  std::vector<RobotJoint> joints = robot.joints();
  joints[1].lower = 1.0;
  joints[1].upper = -1.0;
  EXPECT_EQ(Robot::build(robot.avatar(), joints).error().index, 1);
  joints = robot.joints();
  joints[2].mimicOf = 2;
  EXPECT_EQ(Robot::build(robot.avatar(), joints).error().code, ErrorCode::BadHierarchy);
}

}  // namespace
}  // namespace foretouch
