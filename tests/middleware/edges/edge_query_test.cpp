// Edges by joint angles, held against closed forms and the judge's distance: neither shares code
// with the query.
#include "middleware/edges/edge_query.h"

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
  EdgeScratch scratch;
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
  EdgeScratch scratch;
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
  EdgeScratch scratch;
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
  EdgeScratch scratch;
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

TEST(EdgeQuery, TellsWhatIsWrongWithQ) {
  const Place place = wires({{-1.0, 0.0}});
  const auto edges = EdgeQuery::build(arm(-2.0, 2.0), place.scene).value();
  EdgeScratch scratch;
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
