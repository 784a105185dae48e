// Many edges on threads: the same bytes as one thread's, and how far a path is free.
#include <cmath>
#include <cstring>

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

bool same(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same(const EdgeAnswer& a, const EdgeAnswer& b) {
  return a.verdict == b.verdict && a.reason == b.reason && same(a.freeUntil, b.freeUntil) &&
         a.contact.link == b.contact.link && a.contact.other == b.contact.other &&
         a.contact.triangle == b.contact.triangle && same(a.contact.toi, b.contact.toi) &&
         same(a.contact.separation, b.contact.separation) &&
         a.contact.p_WLink == b.contact.p_WLink && a.contact.p_WScene == b.contact.p_WScene &&
         a.breachAt0.coordinate == b.breachAt0.coordinate &&
         a.breachAt1.coordinate == b.breachAt1.coordinate;
}

class EdgesOnThreads : public testing::Test {
 protected:
  EdgesOnThreads() {
    EdgeOptions options;
    options.self = PairRules::derive(robot_.avatar()).value();
    edges_ = EdgeQuery::build(robot_, place_.scene, options).value();
  }
  Robot robot_ = arm(-2.9, 2.9);
  Place place_ = wires({{0.7, 0.5}, {-0.6, 0.7}, {0.1, -0.9}});
  std::optional<EdgeQuery> edges_;
};

TEST_F(EdgesOnThreads, AnswerAlikeOnAnyNumberOfThreads) {
  constexpr std::size_t kEdges = 1500;
  const auto q0 = randomConfigurations(1, kEdges), q1 = randomConfigurations(2, kEdges);
  std::vector<EdgeAnswer> alone;
  Scratch scratch;
  int clear = 0;
  for (std::size_t i = 0; i < kEdges; ++i) {
    alone.push_back(edges_->answer(&q0[3 * i], &q1[3 * i], 3, scratch).value());
    clear += alone.back().verdict == Verdict::Clear ? 1 : 0;
  }
  EXPECT_GT(clear, 100);
  EXPECT_LT(clear, 1400);
  for (const int threads : {1, 2, 5}) {
    WorkerPool pool = WorkerPool::start(threads).value();
    EXPECT_EQ(pool.threads(), threads);
    std::vector<EdgeAnswer> answers(7);
    for (int round = 0; round < 3; ++round) {
      ASSERT_TRUE(edges_->answerAll(q0.data(), q1.data(), kEdges, pool, answers).ok());
      ASSERT_EQ(answers.size(), kEdges);
      for (std::size_t i = 0; i < kEdges; ++i) {
        ASSERT_TRUE(same(answers[i], alone[i])) << threads << " threads, edge " << i;
      }
    }
    ASSERT_TRUE(edges_->answerAll(nullptr, nullptr, 0, pool, answers).ok());
    EXPECT_TRUE(answers.empty());
  }
}

TEST_F(EdgesOnThreads, TellHowFarAPathIsFree) {
  Scratch scratch;
  int free = 0, met = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    // Short ways, so that several edges are free.
    auto q = randomConfigurations(seed, 40);
    for (std::size_t i = 3; i < q.size(); ++i) q[i] = q[i - 3] + 0.03 * q[i];
    std::size_t first = 0;
    EdgeAnswer expected;
    for (; first < 39; ++first) {
      expected = edges_->answer(&q[3 * first], &q[3 * first + 3], 3, scratch).value();
      if (expected.verdict != Verdict::Clear) break;
    }
    for (const int threads : {1, 3}) {
      WorkerPool pool = WorkerPool::start(threads).value();
      const PathAnswer path = edges_->answerPath(q.data(), 40, pool).value();
      ASSERT_EQ(path.edge, first) << seed;
      EXPECT_TRUE(same(path.answer, expected)) << seed;
      EXPECT_LE(path.freeUntil, static_cast<double>(first) + expected.freeUntil * (first < 39));
      EXPECT_GE(path.freeUntil, static_cast<double>(first));
    }
    (first == 39 ? free : met) += 1;
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(met, 20);
}

TEST_F(EdgesOnThreads, RefuseBadConfigurationsBeforeTheyAsk) {
  WorkerPool pool = WorkerPool::start(2).value();
  const auto q0 = randomConfigurations(1, 20);
  auto q1 = randomConfigurations(2, 20);
  q1[3 * 7 + 1] = std::nan("");
  std::vector<EdgeAnswer> answers;
  const auto refused = edges_->answerAll(q0.data(), q1.data(), 20, pool, answers);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::NonFinite);
  EXPECT_EQ(refused.error().index, 7);
  EXPECT_EQ(edges_->answerPath(q1.data(), 20, pool).error().index, 7);
  EXPECT_EQ(edges_->answerPath(q0.data(), 1, pool).error().code, ErrorCode::Empty);
  EXPECT_FALSE(WorkerPool::start(0).ok());
  EXPECT_FALSE(WorkerPool::start(kMaxPoolThreads + 1).ok());
}

}  // namespace
}  // namespace foretouch
