// How near edges come, held against samples of closed forms and the judge's distance: neither
// shares code with the query.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"
#include "tests/middleware/edges/arm_among_wires.h"

namespace foretouch {
namespace {

using test::arm;
using test::kPi;
using test::Place;
using test::randomConfigurations;
using test::wires;

std::vector<double> at(const double* q0, const double* q1, double t) {
  std::vector<double> q;
  for (std::size_t i = 0; i < 3; ++i) q.push_back(q0[i] + t * (q1[i] - q0[i]));
  return q;
}

/// The least of so many instants, and how much less it may be between two of them.
struct Sampled {
  double least = std::numeric_limits<double>::infinity(), slack = 0.0;
};

Sampled sampled(const oracle::Scene& scene, const double* q0, const double* q1, int samples) {
  Sampled result;
  for (int k = 0; k <= samples; ++k) {
    const double t = static_cast<double>(k) / samples;
    result.least = std::min(result.least, test::separationOf(scene, at(q0, q1, t)));
  }
  // No point is farther from a joint than the arm's length beyond it.
  const double speed =
      1.2 * std::abs(q1[0] - q0[0]) + 0.8 * std::abs(q1[1] - q0[1]) + 0.4 * std::abs(q1[2] - q0[2]);
  result.slack = 0.5 * speed / samples;
  return result;
}

class EdgeClearances : public testing::Test {
 protected:
  explicit EdgeClearances(double tolerance = 1e-4) {
    EdgeOptions options;
    options.clearanceTolerance = tolerance;
    edges_ = EdgeQuery::build(robot_, place_.scene, options).value();
  }
  Robot robot_ = arm();
  Place place_ = wires({{0.7, 0.5}, {-0.6, 0.7}, {0.1, -0.9}, {-1.3, -0.3}});
  std::optional<EdgeQuery> edges_;
  Scratch scratch_;
};

TEST_F(EdgeClearances, HoldBetweenBothBounds) {
  constexpr std::size_t kEdges = 400;
  const auto q0 = randomConfigurations(1, kEdges), q1 = randomConfigurations(2, kEdges);
  int touching = 0, alone = 0;
  for (std::size_t i = 0; i < kEdges; ++i) {
    const double *const from = &q0[3 * i], *const to = &q1[3 * i];
    const EdgeClearance clearance = edges_->clearance(from, to, 3, scratch_).value();
    const Sampled truth = sampled(place_.judged, from, to, 2000);
    ASSERT_LE(clearance.lower, std::max(0.0, truth.least)) << i;
    ASSERT_GE(clearance.upper, truth.least - truth.slack) << i;
    ASSERT_LE(clearance.upper - clearance.lower, 1.0001e-4) << i;
    touching += clearance.upper == 0.0 ? 1 : 0;
    alone += clearance.isAlone ? 1 : 0;
    const double there =
        std::max(0.0, test::separationOf(place_.judged, at(from, to, clearance.t)));
    EXPECT_NEAR(there, clearance.upper, 1e-5) << i;
    if (there == 0.0) continue;
    EXPECT_NEAR((clearance.p_WLink - clearance.p_WScene).norm(), there, 1e-5) << i;
    EXPECT_NEAR((clearance.p_WLink - clearance.p_WScene).dot(clearance.nhat_SL_W), there, 1e-5);
  }
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 380);
  EXPECT_GT(alone, 15);
}

TEST_F(EdgeClearances, LongWaysAreCut) {
  const double q0[3] = {-6.5, 1.0, 1.0}, q1[3] = {6.5, 1.2, 1.4};
  const EdgeClearance clearance = edges_->clearance(q0, q1, 3, scratch_).value();
  const Sampled truth = sampled(place_.judged, q0, q1, 20'000);
  EXPECT_LE(clearance.lower, std::max(0.0, truth.least));
  EXPECT_NEAR(test::separationOf(place_.judged, at(q0, q1, clearance.t)), clearance.upper, 1e-5);
}

TEST_F(EdgeClearances, SlopesAreThoseOfSmallSteps) {
  constexpr std::size_t kEdges = 40;
  const auto q0 = randomConfigurations(3, kEdges), q1 = randomConfigurations(4, kEdges);
  int tried = 0;
  for (std::size_t i = 0; i < kEdges; ++i) {
    std::vector<double> ends(&q0[3 * i], &q0[3 * i] + 3);
    ends.insert(ends.end(), &q1[3 * i], &q1[3 * i] + 3);
    // A short edge: along a long one the least separation is more often of two kinds.
    for (std::size_t k = 0; k < 3; ++k) ends[3 + k] = ends[k] + 0.2 * (ends[3 + k] - ends[k]);
    double slopes[6];
    const EdgeClearance clearance =
        edges_->clearance(&ends[0], &ends[3], 3, scratch_, slopes, slopes + 3).value();
    if (!clearance.isAlone || clearance.upper < 0.01) continue;
    ++tried;
    for (std::size_t k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-3;
      std::vector<double> more = ends, less = ends;
      more[k] += kStep;
      less[k] -= kStep;
      const double change = sampled(place_.judged, &more[0], &more[3], 400).least -
                            sampled(place_.judged, &less[0], &less[3], 400).least;
      EXPECT_NEAR(slopes[k], change / (2 * kStep), 0.02) << i << " by " << k;
    }
  }
  EXPECT_GT(tried, 8);
}

TEST_F(EdgeClearances, AreAlikeOnAnyNumberOfThreads) {
  constexpr std::size_t kEdges = 500;
  const auto q0 = randomConfigurations(5, kEdges), q1 = randomConfigurations(6, kEdges);
  std::vector<EdgeClearance> first;
  std::vector<double> firstSlopes;
  for (const int threads : {1, 3}) {
    WorkerPool pool = WorkerPool::start(threads).value();
    std::vector<EdgeClearance> answers;
    std::vector<double> slopes(6 * kEdges);
    ASSERT_TRUE(edges_
                    ->clearanceAll(q0.data(), q1.data(), kEdges, pool, answers, slopes.data(),
                                   slopes.data() + 3 * kEdges)
                    .ok());
    ASSERT_EQ(answers.size(), kEdges);
    if (first.empty()) {
      first = answers;
      firstSlopes = slopes;
    }
    EXPECT_EQ(std::memcmp(slopes.data(), firstSlopes.data(), sizeof(double) * slopes.size()), 0);
    for (std::size_t i = 0; i < kEdges; ++i) {
      const EdgeClearance alone = edges_->clearance(&q0[3 * i], &q1[3 * i], 3, scratch_).value();
      for (const EdgeClearance& other : {answers[i], alone}) {
        ASSERT_EQ(other.lower, first[i].lower);
        ASSERT_EQ(other.upper, first[i].upper);
        ASSERT_EQ(other.t, first[i].t);
        ASSERT_EQ(other.triangle, first[i].triangle);
      }
    }
  }
}

TEST(EdgeClearance, SeesPropsWhereTheyAre) {
  const Place far = wires({{5.0, 5.0}}), near = wires({{0.0, 0.0}});
  EdgeOptions options;
  options.props = {{near.scene, std::nullopt, {}}};
  auto edges = EdgeQuery::build(arm(), far.scene, options).value();
  Scratch scratch;
  const double q0[3] = {0.0, 0.0, 0.0}, q1[3] = {0.3, 0.0, 0.0};
  EXPECT_EQ(edges.clearance(q0, q1, 3, scratch).value().prop, -1);
  const Eigen::Vector3d place(1.25, -0.01, 0.0);
  ASSERT_TRUE(edges.place(0, RigidPose{Quaternion::Identity(), place}).ok());
  const EdgeClearance clearance = edges.clearance(q0, q1, 3, scratch).value();
  EXPECT_EQ(clearance.prop, 0);
  const Place there = wires({{1.25, -0.01}});
  const double truth = sampled(there.judged, q0, q1, 2000).least;
  EXPECT_LE(clearance.lower, truth);
  EXPECT_NEAR(clearance.upper, truth, 1e-3);
  EXPECT_NEAR(clearance.p_WScene.x(), 1.25, 0.01);
}

// The arm points straight at a wire, two metres from its base.
TEST(EdgeClearance, OfAPropIsNeverMoreThanItIs) {
  const Place far = wires({{5.0, 5.0}}), wire = wires({{0.0, 0.0}});
  constexpr double kTruth = 2.0 - 3 * 0.4 - 0.03, kRounding = 1e-12;
  EdgeOptions options;
  options.clearanceTolerance = 1e-8;
  options.props = {{wire.scene, std::nullopt, {}}};
  auto edges = EdgeQuery::build(arm(), far.scene, options).value();
  Scratch scratch;
  for (int i = 0; i < 20; ++i) {
    const double angle = 0.3 * i - 3.0;
    const Eigen::Vector3d place(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.0);
    const Quaternion turn(std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle));
    ASSERT_TRUE(edges.place(0, RigidPose{turn, place}).ok());
    const double from[3] = {angle, 0.0, 0.0}, away[3] = {angle + 0.01, 0.0, 0.0};
    for (const double* const to : {from, away}) {
      const EdgeClearance clearance = edges.clearance(from, to, 3, scratch).value();
      EXPECT_LE(clearance.lower, kTruth + kRounding) << angle;
      EXPECT_GE(clearance.upper, kTruth - kRounding) << angle;
      EXPECT_NEAR(clearance.lower, clearance.upper, 1.1e-8) << angle;
    }
  }
}

TEST(EdgeClearance, LooksNoFartherThanItIsTold) {
  const Place place = wires({{3.0, 0.0}});
  EdgeOptions options;
  options.clearanceWithin = 0.5;
  const auto edges = EdgeQuery::build(arm(), place.scene, options).value();
  Scratch scratch;
  const double q0[3] = {0.0, 0.0, 0.0}, q1[3] = {0.3, 0.0, 0.0};
  const EdgeClearance clearance = edges.clearance(q0, q1, 3, scratch).value();
  EXPECT_EQ(clearance.lower, 0.5);
  EXPECT_EQ(clearance.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(clearance.triangle, -1);
}

TEST(EdgeClearance, RefusesWhatItCannotHonour) {
  const Place place = wires({{3.0, 0.0}});
  for (const double bad : {0.0, -1.0, 1e9, std::nan("")}) {
    EdgeOptions options;
    options.clearanceTolerance = bad;
    const auto refused = EdgeQuery::build(arm(), place.scene, options);
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_NE(describe(refused.error()).find("tolerance"), std::string::npos);
    options = {};
    options.clearanceWithin = bad > 0.0 ? std::nan("") : bad;
    EXPECT_FALSE(EdgeQuery::build(arm(), place.scene, options).ok());
  }
  const auto edges = EdgeQuery::build(arm(), place.scene).value();
  Scratch scratch;
  const double fine[3] = {0, 0, 0}, bad[3] = {0, std::nan(""), 0};
  EXPECT_EQ(edges.clearance(fine, bad, 3, scratch).error().code, ErrorCode::NonFinite);
  EXPECT_FALSE(edges.clearance(fine, fine, 2, scratch).ok());
}

}  // namespace
}  // namespace foretouch
