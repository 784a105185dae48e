// A served pose where memory ends: every allocation from its bytes to the bytes of its answer fails
// once. Nothing but std::bad_alloc comes of it, which ends a service with its reason; and what was
// asked after it is answered as ever.
#include <cstdint>
#include <new>

#include <gtest/gtest.h>

#include "network/stream/stream_solver.h"
#include "network/wire/codec.h"
#include "tests/network/small_stream.h"
#include "tests/support/allocation_count.h"

namespace foretouch::test {
namespace {

Scene floorBelow() {
  RawScene raw;
  raw.triangles.push_back(
      {{Eigen::Vector3d(-9, 0.5, -9), Eigen::Vector3d(9, 0.5, -9), Eigen::Vector3d(0, 0.5, 9)}});
  raw.objectOf = {0};
  raw.objectNames = {"floor"};
  return Scene::build(std::move(raw)).value();
}

Bytes bytesOf(const PoseMessage& message) {
  Bytes bytes;
  encode(message, bytes);
  return bytes;
}

/// From the bytes of a pose to those of its answer; those of the query's time are zero.
Bytes served(StreamSolver& solver, const Bytes& pose) {
  PoseMessage message;
  ContactsMessage answer;
  if (decode({pose.data(), pose.size()}, message) != Reject::None) return {};
  if (solver.take(message, answer) != Reject::None) return {};
  answer.queryUs = 0.0;
  Bytes bytes;
  encode(answer, bytes);
  return bytes;
}

StreamSolver followed(const Scene& scene) {
  auto solver = StreamSolver::make(0, smallAvatar(), scene, {}, {}).value();
  EXPECT_EQ(solver.take(skeletonMessage(smallSkeleton())), Reject::None);
  return solver;
}

TEST(ServedPose, SurvivesWhicheverAllocationFails) {
  if (!countsAllocations()) GTEST_SKIP() << "allocations cannot be made to fail here";
  const Scene scene = floorBelow();
  const Bytes first = bytesOf(nthPose(0)), second = bytesOf(nthPose(1)),
              third = bytesOf(nthPose(2));
  StreamSolver undisturbed = followed(scene);
  ASSERT_FALSE(served(undisturbed, first).empty());
  const Bytes expected = served(undisturbed, second);
  ASSERT_FALSE(expected.empty());
  ASSERT_FALSE(served(undisturbed, third).empty());
  int failed = 0;
  for (bool hasFailed = true; hasFailed && failed < 10'000;) {
    StreamSolver solver = followed(scene);  // a fresh one, which has to grow
    ASSERT_FALSE(served(solver, first).empty());
    Bytes answer;
    failAllocationAfter(failed);
    try {
      answer = served(solver, second);
    } catch (const std::bad_alloc&) {
    }
    hasFailed = stopFailing();
    failed += hasFailed ? 1 : 0;
    EXPECT_TRUE(answer.empty() || answer == expected) << failed;
    EXPECT_TRUE(hasFailed || answer == expected);
    // Whether the pose counts as taken or as lost, the next one is answered.
    EXPECT_FALSE(served(solver, third).empty()) << failed;
  }
  EXPECT_GT(failed, 5);
}

}  // namespace
}  // namespace foretouch::test
