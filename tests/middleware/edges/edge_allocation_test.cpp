// Edges allocate nothing once the threads' memory has grown. A program of its own: it counts the
// calls of malloc.
#include <vector>

#include <gtest/gtest.h>

#include "middleware/edges/edge_query.h"
#include "middleware/worker_pool.h"
#include "tests/middleware/edges/arm_among_wires.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

class EdgeAllocations : public testing::TestWithParam<int> {
 protected:
  EdgeAllocations() {
    EdgeOptions options;
    options.self = PairRules::derive(robot_.avatar()).value();
    const RigidPose aside{Quaternion::Identity(), {-0.2, 0.1, 0.0}};
    options.props = {{test::wires({{-0.5, -0.6}}).scene, aside, {}}};
    edges_ = EdgeQuery::build(robot_, place_.scene, options).value();
  }
  Robot robot_ = test::arm(-2.9, 2.9);
  test::Place place_ = test::wires({{0.7, 0.5}, {-0.6, 0.7}, {0.1, -0.9}});
  std::optional<EdgeQuery> edges_;
};

TEST_P(EdgeAllocations, StopOnceThePoolHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "the build has its own allocator";
  constexpr std::size_t kEdges = 400;
  const auto q0 = test::randomConfigurations(1, kEdges), q1 = test::randomConfigurations(2, kEdges);
  WorkerPool pool = WorkerPool::start(GetParam()).value();
  std::vector<EdgeAnswer> answers;
  std::vector<EdgeClearance> clearances;
  std::vector<double> slopes(3 * kEdges);
  const auto ask = [&] {
    ASSERT_TRUE(edges_->answerAll(q0.data(), q1.data(), kEdges, pool, answers).ok());
    ASSERT_TRUE(
        edges_->clearanceAll(q0.data(), q1.data(), kEdges, pool, clearances, slopes.data(), nullptr)
            .ok());
    ASSERT_TRUE(edges_->answerPath(q0.data(), kEdges, pool).ok());
  };
  // Which thread takes which edge is chance: until each has met the largest, memory may grow. So it
  // is a steady state that is looked for: many rounds in a row without an allocation.
  constexpr int kRounds = 400, kQuiet = 25;
  int quiet = 0;
  for (int round = 0; round < kRounds && quiet < kQuiet; ++round) {
    const std::uint64_t before = test::numAllocations();
    ask();
    quiet = test::numAllocations() == before ? quiet + 1 : 0;
  }
  EXPECT_EQ(quiet, kQuiet);
  int clear = 0, met = 0;
  for (const EdgeAnswer& answer : answers) {
    clear += answer.verdict == Verdict::Clear ? 1 : 0;
    met += answer.verdict == Verdict::Contact ? 1 : 0;
  }
  EXPECT_GT(clear, 20);
  EXPECT_GT(met, 20);
}

INSTANTIATE_TEST_SUITE_P(Threads, EdgeAllocations, testing::Values(1, 3));

/// With one thread and its own scratch there is no chance: the second round is like the first.
TEST(Scratch, IsAllThatAnEdgeNeeds) {
  if (!test::countsAllocations()) GTEST_SKIP() << "the build has its own allocator";
  const Robot robot = test::arm();
  const test::Place place = test::wires({{0.7, 0.5}, {-0.6, 0.7}});
  const EdgeQuery edges = EdgeQuery::build(robot, place.scene).value();
  const auto q = test::randomConfigurations(3, 300);
  Scratch scratch;
  std::uint64_t first = 0;
  for (int round = 0; round < 2; ++round) {
    const std::uint64_t before = test::numAllocations();
    for (std::size_t i = 0; i + 1 < 300; ++i) {
      ASSERT_TRUE(edges.answer(&q[3 * i], &q[3 * i + 3], 3, scratch).ok());
    }
    if (round == 0) first = test::numAllocations() - before;
    if (round == 1) {
      EXPECT_EQ(test::numAllocations(), before);
    }
  }
  EXPECT_GT(first, 0U);  // they are counted
}

}  // namespace
}  // namespace foretouch
