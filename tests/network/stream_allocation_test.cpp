// Counts every call of malloc and its kin in this program: once a stream has seen its poses, it
// makes none a pose.
#include <atomic>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "network/avatar_stream.h"
#include "tests/network/small_stream.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define FORETOUCH_COUNTS_ALLOCATIONS 0
#else
#define FORETOUCH_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<std::uint64_t> allocations{0};
}

#if FORETOUCH_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace foretouch {
namespace {

TEST(StreamAllocations, AreNoneAPose) {
  if (FORETOUCH_COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "this build has an allocator of its own";
  AvatarStream stream = AvatarStream::make(test::smallAvatar(), {}).value();
  ASSERT_EQ(stream.take(test::skeletonMessage(test::smallSkeleton())), Reject::None);
  std::vector<PoseMessage> poses;
  for (std::int64_t n = 0; n < 500; ++n) {
    poses.push_back(test::nthPose(n % 50 == 49 ? n - 20 : n));  // some are refused
    if (n % 7 == 0) poses.back().joints.pop_back();
  }
  StreamStep step;
  ASSERT_EQ(stream.take(poses[0], step), Reject::None);
  const std::uint64_t before = allocations;
  std::uint64_t accepted = 0;
  for (const PoseMessage& pose : poses) {
    if (stream.take(pose, step) == Reject::None) ++accepted;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(before, 0U);
  EXPECT_GT(accepted, 400U);
}

}  // namespace
}  // namespace foretouch
