// A sample of random worlds, and proof that the judge finds what is wrong. At length: ./run
// world-fuzz.
#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "tests/world_fuzz/fuzz_run.h"

namespace foretouch::test {
namespace {

TEST(WorldFuzz, NothingIsWrong) {
  constexpr std::uint64_t kSeeds = 500;
  FuzzTally all;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const FuzzTally one = runFuzzWorld(seed);
    EXPECT_EQ(one.wrong(), 0U) << "seed " << seed << ": " << one.first
                               << "\nagain: ./run world-fuzz --first " << seed << " --seeds 1";
    all.add(one);
  }
  EXPECT_GT(all.contacts, 2 * kSeeds);
  EXPECT_GT(all.triggerEvents, kSeeds);
}

// A trigger's box had its triangles in another order in C than in a file, and so told of a touch at
// the same instant another triangle first.
TEST(WorldFuzz, ABoxIsTheSameInAFileAndInC) {
  for (const std::uint64_t seed : {10476U, 14702U, 104693U}) {
    const FuzzTally one = runFuzzWorld(seed);
    EXPECT_EQ(one.faults[static_cast<std::size_t>(FuzzFault::Differs)], 0U)
        << "seed " << seed << ": " << one.first;
  }
}

/// After how many worlds a lie is found as this; 0: never.
std::uint64_t worldsUntil(FuzzFault fault, const std::function<void(FuzzTold&)>& lie) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    if (runFuzzWorld(seed, lie).faults[static_cast<std::size_t>(fault)] > 0) return seed + 1;
  }
  return 0;
}

void leaveOut(FuzzTold& told, EventKind kind) {
  auto& events = told.events;
  events.erase(std::remove_if(events.begin(), events.end(),
                              [&](const WorldEvent& event) { return event.kind == kind; }),
               events.end());
}

TEST(WorldFuzz, LiesAreFound) {
  EXPECT_GT(worldsUntil(FuzzFault::Missed,
                        [](FuzzTold& told) { leaveOut(told, EventKind::StartsInside); }),
            0U);
  EXPECT_GT(worldsUntil(FuzzFault::Loose, [](FuzzTold& told) { leaveOut(told, EventKind::Enter); }),
            0U);
  EXPECT_GT(worldsUntil(FuzzFault::Open, [](FuzzTold& told) { leaveOut(told, EventKind::Leave); }),
            0U);
  EXPECT_GT(
      worldsUntil(FuzzFault::Order,
                  [](FuzzTold& told) { std::reverse(told.events.begin(), told.events.end()); }),
      0U);
  const auto shift = [](std::int64_t us) {
    return [us](FuzzTold& told) {
      for (WorldEvent& event : told.events) {
        if (event.kind == EventKind::Enter) event.time.us += us;
      }
    };
  };
  EXPECT_GT(worldsUntil(FuzzFault::Late, shift(500)), 0U);
  EXPECT_GT(worldsUntil(FuzzFault::Early, shift(-500)), 0U);
}

}  // namespace
}  // namespace foretouch::test
