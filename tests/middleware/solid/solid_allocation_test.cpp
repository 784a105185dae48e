// tests/middleware/solid/solid_allocation_test.cpp: a tick allocates nothing once memory has grown.
#include <cmath>

#include "tests/middleware/solid/solid_runner.h"
#include "tests/support/allocation_count.h"

namespace foretouch::test {
namespace {

TEST(SolidAllocation, NoTickAllocatesOnceMemoryHasGrown) {
  if (!countsAllocations()) GTEST_SKIP() << "the build has an allocator of its own";
  SolidRunner run(wallAt(-0.5, 20));
  // To and fro in 64 ticks, again and again.
  const auto targetAt = [&](int i) { return reaching(run, 0.9 + 0.7 * std::sin(M_PI / 32.0 * i)); };
  for (int i = 0; i < 256; ++i) run.follow(targetAt(i));
  std::uint64_t allocated = 0, inContact = 0;
  for (int i = 256; i < 384; ++i) {
    const Pose target = targetAt(i);
    const std::uint64_t before = numAllocations();
    const bool isDone = run.solid.follow({target, 1.0 / 90.0, nullptr}, run.tick).ok();
    allocated += numAllocations() - before;
    ASSERT_TRUE(isDone);
    inContact += run.tick.state != SolidState::Equal;
  }
  EXPECT_EQ(allocated, 0u);
  EXPECT_GT(inContact, 20u);
}

}  // namespace
}  // namespace foretouch::test
