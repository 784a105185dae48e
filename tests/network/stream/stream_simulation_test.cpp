// A sample of the simulation, and proof that it finds what is broken. At length: ./run simulate.
#include "tests/network/stream/stream_simulation.h"

#include <algorithm>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/network/stream/stream_attack.h"

namespace foretouch::test {
namespace {

constexpr std::uint64_t kSeeds = 1000;

TEST(StreamSimulation, KeepsEveryPromise) {
  SimulationTally all, lossAlone;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const SimulationRun run = simulate(seed);
    all.add(run.tally);
    if (run.isLossAlone) lossAlone.add(run.tally);
    for (const std::string& violation : run.violations) {
      ADD_FAILURE() << "seed " << seed << ": " << violation << "\nagain: ./run simulate --first "
                    << seed << " --seeds 1";
    }
  }
  // The sample reaches what it is about.
  const std::uint64_t linkSteps = all.linkSteps();
  const auto verdicts = [&](Verdict v) { return all.verdicts[static_cast<std::size_t>(v)]; };
  EXPECT_GT(verdicts(Verdict::Clear), linkSteps / 4);
  EXPECT_GT(verdicts(Verdict::Contact), linkSteps / 100);
  EXPECT_GT(verdicts(Verdict::StartsInContact), linkSteps / 100);
  EXPECT_GT(verdicts(Verdict::Undecided), linkSteps / 10);
  EXPECT_EQ(all.unproved, 0U);
  EXPECT_GT(all.answered, all.posesSent / 2);
  for (const UndecidedReason reason :
       {UndecidedReason::WorkBudget, UndecidedReason::Gap, UndecidedReason::MissingJoint,
        UndecidedReason::InvalidJoint, UndecidedReason::StaleJoint,
        UndecidedReason::UnmatchedJoint}) {
    EXPECT_GT(all.reasons[static_cast<std::size_t>(reason)], 100U) << toString(reason);
  }
  for (const Reject reject :
       {Reject::Length, Reject::Fingerprint, Reject::Version, Reject::Limit, Reject::NonFinite,
        Reject::NonUnit, Reject::OutOfRange, Reject::BadName, Reject::BadIndex, Reject::BadHash,
        Reject::UnknownAvatar, Reject::OldGeneration, Reject::UnknownSkeleton,
        Reject::SkeletonMismatch, Reject::Duplicate, Reject::OutOfOrder, Reject::StaleStamp,
        Reject::FutureStamp, Reject::OldSession}) {
    EXPECT_GT(all.rejects[static_cast<std::size_t>(reject)], 0U) << toString(reject);
  }
  // Nothing but loss: nothing is refused that arrived after its skeleton.
  EXPECT_EQ(lossAlone.alteredAnswered, 0U);
  for (std::size_t i = 0; i < kNumRejects; ++i) {
    const auto reject = static_cast<Reject>(i);
    if (reject == Reject::UnknownSkeleton || reject == Reject::OutOfOrder) continue;
    EXPECT_EQ(lossAlone.rejects[i], 0U) << toString(reject);
  }
}

TEST(StreamSimulation, IsDecidedByItsSeed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SimulationTally one = simulate(seed).tally, other = simulate(seed).tally;
    EXPECT_EQ(one.verdicts, other.verdicts);
    EXPECT_EQ(one.rejects, other.rejects);
    EXPECT_EQ(one.reasons, other.reasons);
  }
}

/// How a broken rule shows: mostly by what the oracle says of the motion that nobody saw.
std::string traceOf(Mutation mutation) {
  switch (mutation) {
    case Mutation::RestartsAreSteps: return "is a step from one sender to another";
    case Mutation::CopiesAreNew: return "has been answered before";
    case Mutation::ContactsAreLate: return "contact -> late";
    default: return "clear -> missed";
  }
}

class BrokenRules : public testing::TestWithParam<Mutation> {};

TEST_P(BrokenRules, AreFound) {
  SimulationOptions options;
  options.mutation = GetParam();
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const std::string& violation : simulate(seed, options).violations) {
      if (violation.find(traceOf(GetParam())) != std::string::npos) return;
    }
  }
  FAIL() << "no seed below " << kSeeds << " found it";
}

INSTANTIATE_TEST_SUITE_P(All, BrokenRules, testing::ValuesIn(kMutations),
                         [](const auto& parameter) {
                           std::string name = toString(parameter.param);
                           for (char& c : name) {
                             if (c == '-') c = '_';
                           }
                           return name;
                         });

TEST(StreamAttack, StopsNoTrueSender) {
  std::map<Standpoint, AttackTally> tallies;
  for (std::uint64_t seed = 0; seed < 2 * kSeeds; ++seed) {
    const AttackRun run = attack(seed);
    tallies[run.standpoint].add(run.tally);
    for (const std::string& violation : run.violations) {
      ADD_FAILURE() << "seed " << seed << ": " << violation
                    << "\nagain: ./run simulate --adversary --first " << seed << " --seeds 1";
    }
  }
  ASSERT_EQ(tallies.size(), 3U);
  for (const auto& [standpoint, tally] : tallies) {
    EXPECT_LE(tally.longestRun, mostStopped(standpoint));
    EXPECT_GT(tally.truePoses, 10 * kSeeds);
    EXPECT_GT(tally.hostile, tally.seeds / 2);
  }
  EXPECT_GT(tallies[Standpoint::OtherSenders].hostile, tallies[Standpoint::OtherSenders].truePoses);
  // The attacks have an effect where one is possible, so none would not be for want of trying.
  EXPECT_GT(tallies[Standpoint::SameSender].unanswered, 100U);
  EXPECT_GT(tallies[Standpoint::SameSender].hostileAnswered, 100U);
  EXPECT_GT(tallies[Standpoint::Before].takeovers, 10U);
}

TEST(StreamAttack, StopsSendersWhereNobodyIsBound) {
  std::uint64_t longest = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const AttackRun run = attack(seed, /*isBound=*/false);
    if (run.standpoint == Standpoint::OtherSenders)
      longest = std::max(longest, run.tally.longestRun);
  }
  EXPECT_GT(longest, 10U);
}

}  // namespace
}  // namespace foretouch::test
