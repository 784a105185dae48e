// A sample of live worlds over a faulty network, and proof that the judge finds what is broken. At
// length: ./run simulate --world.
#include <gtest/gtest.h>

#include "tests/network/world_stream/crowd_simulation.h"

namespace foretouch::test {
namespace {

constexpr std::uint64_t kCrowdSeeds = 300;

TEST(WorldStreamSimulation, EveryEventIsTrueOrMarkedAndAReplayTellsTheSame) {
  CrowdTally all, calm;
  for (std::uint64_t seed = 0; seed < kCrowdSeeds; ++seed) {
    const CrowdRun run = simulateCrowd(seed);
    all.add(run.tally);
    if (!run.isFaulty) calm.add(run.tally);
    for (const std::string& violation : run.violations) {
      ADD_FAILURE() << "seed " << seed << ": " << violation
                    << "\nagain: ./run simulate --world --first " << seed << " --seeds 1";
    }
  }
  // The sample has all of it.
  EXPECT_GT(all.marked, 500U);
  EXPECT_GT(all.ofAvatars, 500U);
  EXPECT_GT(all.ofAvatarAndProp, 500U);
  EXPECT_GT(all.ofProps, 200U);
  EXPECT_GT(all.ofOwnLinks, 100U);
  EXPECT_GT(all.ofScene, 200U);
  EXPECT_GT(all.ofCarried, 100U);
  EXPECT_GT(all.touching, 10'000U);
  EXPECT_EQ(all.unproved, 0U);
  EXPECT_EQ(all.failures, 0U);
  EXPECT_GT(all.refused, 500U);
  EXPECT_GT(all.silences, 20U);
  EXPECT_GT(all.gaps, 500U);
  EXPECT_GT(all.lateChanges, 10U);
  // Neither is everything unknown: nothing is, where nothing is lost, but beside changes.
  EXPECT_GT(2 * all.freeSeconds, all.unknownSeconds);
  EXPECT_GT(calm.freeSeconds, 10 * calm.unknownSeconds);
  EXPECT_GT(all.freeSeconds, 20 * all.lateSeconds);
}

// Whatever a stranger says of bodies of his own, what is told of the others stays true, and they
// are not forgotten over him: they are known for nearly as long as without him.
TEST(WorldStreamSimulation, AStrangerHarmsNobody) {
  CrowdTally alone, beside;
  for (std::uint64_t seed = 0; seed < kCrowdSeeds; ++seed) {
    alone.add(simulateCrowd(seed).tally);
    const CrowdRun run = simulateCrowd(seed, CrowdMutation::None, true);
    beside.add(run.tally);
    for (const std::string& violation : run.violations) {
      ADD_FAILURE() << "seed " << seed << ": " << violation
                    << "\nagain: ./run simulate --world --adversary --first " << seed
                    << " --seeds 1";
    }
  }
  EXPECT_GT(beside.freeSeconds, 0.9 * alone.freeSeconds);
  EXPECT_GT(beside.events - beside.marked, (alone.events - alone.marked) * 9 / 10);
  EXPECT_GT(beside.refused, alone.refused + 10'000) << "he says what nobody believes";
}

class BrokenWorlds : public testing::TestWithParam<CrowdMutation> {};

TEST_P(BrokenWorlds, AreFound) {
  for (std::uint64_t seed = 0; seed < kCrowdSeeds; ++seed) {
    if (!simulateCrowd(seed, GetParam()).violations.empty()) return;
  }
  FAIL() << "no seed below " << kCrowdSeeds << " found it";
}

INSTANTIATE_TEST_SUITE_P(All, BrokenWorlds, testing::ValuesIn(kCrowdMutations),
                         [](const auto& parameter) {
                           std::string name = toString(parameter.param);
                           for (char& c : name) {
                             if (c == '-') c = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace foretouch::test
