// tests/oracle/own_links_sample_test.cpp: a sample of the sweep over a body's own links, short
// enough for every change, and the control: lies planted in its answers, each of which must be
// named. The whole: oracle_sweep --self.
#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/oracle/sweep.h"
#include "tests/support/shared_data.h"
#include "tests/support/widest_afterwards.h"

namespace foretouch::test {
namespace {

/// The clip with nothing around it, its pairs asked by the derived rules.
SweepTally sweepOwnLinks(const SweepClip& clip, SweepOptions options) {
  static const SweepScene nothing = emptySurroundings();
  options.self = PairRules::derive(clip.avatar).value();
  return sweep(clip, nothing, Placement{}, options);
}

void expectKept(const SweepTally& total) {
  std::cout << total.summary() << "\n";
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_EQ(total.of(oracle::Finding::Unproved), 0u);
  EXPECT_EQ(total.of(oracle::Verdict::Undecided), 0u);  // no budget was set
  EXPECT_GT(total.of(oracle::Verdict::Clear), total.judged / 2);
}

TEST(OracleSampleOfOwnLinks, EveryAnswerKeepsThePromise) {
  const WidestAfterwards widest;
  SweepTally total;
  for (const char* name : {"cmu_01_01_playground_jumps.bvh", "bandai1_slash_normal_001.bvh",
                           "cmu_cgspeed_walk_crlf.bvh", "pybvh_per_joint_orders.bvh"}) {
    FORETOUCH_REQUIRE_SHARED(path, std::string("mocap/") + name);
    const auto clip = loadClip(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    for (const Simd simd : supportedSimd()) {
      ASSERT_TRUE(useSimd(simd));
      for (const double rate : {5.0, 30.0}) {
        for (const double tolerance : {1e-3, 1e-5}) {
          SweepOptions options;
          options.rateHz = rate;
          options.tolerance = tolerance;
          options.maxSteps = 30;
          total.add(sweepOwnLinks(clip.value(), options));
        }
      }
    }
  }
  expectKept(total);
  EXPECT_GT(total.of(oracle::Verdict::Contact), 100 * supportedSimd().size());
  EXPECT_GT(total.of(oracle::Verdict::StartsInContact), 300 * supportedSimd().size());
}

// Exact fidelity, by the triangles of both links.
TEST(OracleSampleOfOwnLinks, EveryExactAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(path, "avatars/robot_expressive.glb");
  const auto clip = loadClip(*path);
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  SweepTally total;
  for (const double tolerance : {1e-3, 1e-5, 1e-6}) {
    SweepOptions options;
    options.rateHz = 5.0;
    options.tolerance = tolerance;
    options.maxSteps = 8;
    total.add(sweepOwnLinks(clip.value(), options));
  }
  expectKept(total);
  EXPECT_GT(total.of(oracle::Verdict::Contact), 5u);
  EXPECT_GT(total.of(oracle::Verdict::StartsInContact), 5u);
}

/// What a work budget leaves undecided is free as far as it says.
TEST(OracleSampleOfOwnLinks, EveryUndecidedAnswerKeepsThePromise) {
  FORETOUCH_REQUIRE_SHARED(path, "mocap/cmu_cgspeed_walk_crlf.bvh");
  const auto clip = loadClip(*path);
  ASSERT_TRUE(clip.ok()) << describe(clip.error());
  SweepTally total;
  for (const std::uint64_t budget : {1u, 300u, 1000u, 3000u}) {
    SweepOptions options;
    options.rateHz = 5.0;
    options.workBudget = budget;
    total.add(sweepOwnLinks(clip.value(), options));
  }
  for (const std::string& line : total.violations) ADD_FAILURE() << line;
  EXPECT_EQ(total.broken(), 0u);
  EXPECT_GT(total.of(oracle::Verdict::Undecided), 50u);
}

class OwnLinksControl : public ::testing::Test {
 protected:
  using Pairs = std::vector<PairContact>;

  void tellLies(const std::function<void(Pairs&)>& tamper) {
    FORETOUCH_REQUIRE_SHARED(path, "mocap/bandai1_dance-short_normal_001.bvh");
    const auto clip = loadClip(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    SweepOptions options;
    options.tolerance = 1e-6;  // so that almost no contact is one of mere nearness
    honest_ = sweepOwnLinks(clip.value(), options);
    options.tamperWithPairs = tamper;
    lied_ = sweepOwnLinks(clip.value(), options);
    contacts_ = honest_.of(oracle::Verdict::Contact);
    ASSERT_GT(contacts_, 50u);
    EXPECT_EQ(honest_.broken(), 0u);
  }
  /// The same for every contact in the list.
  void tellLiesOfContacts(const std::function<void(PairContact&)>& tamper) {
    tellLies([&tamper](Pairs& pairs) {
      for (PairContact& pair : pairs) {
        if (pair.verdict == Verdict::Contact) tamper(pair);
      }
    });
  }
  SweepTally honest_, lied_;
  std::uint64_t contacts_ = 0;
};

TEST_F(OwnLinksControl, NamesPairsThatAreKeptBack) {
  tellLies([](Pairs& pairs) { pairs.clear(); });
  if (IsSkipped() || HasFatalFailure()) return;
  // Some graze: they come within the tolerance and turn away.
  EXPECT_GT(lied_.of(oracle::Finding::Missed),
            contacts_ * 8 / 10 + honest_.of(oracle::Verdict::StartsInContact) - 5);
}

TEST_F(OwnLinksControl, NamesContactsThatAreLate) {
  tellLiesOfContacts([](PairContact& c) { c.toi = c.freeUntil = std::min(1.0, c.toi + 1e-3); });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Late), contacts_ * 8 / 10);
}

TEST_F(OwnLinksControl, NamesContactsThatAreEarly) {
  tellLiesOfContacts([](PairContact& c) { c.toi = c.freeUntil = 0.99 * c.toi; });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Early), contacts_ * 9 / 10);
}

TEST_F(OwnLinksControl, NamesStartsThatAreNone) {
  tellLiesOfContacts([](PairContact& c) {
    c.verdict = Verdict::StartsInContact;
    c.toi = c.freeUntil = c.separation = 0.0;
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GE(lied_.of(oracle::Finding::WrongStart), contacts_ * 9 / 10);
}

TEST_F(OwnLinksControl, NamesWitnessesOfTheWrongLink) {
  tellLiesOfContacts([](PairContact& c) {
    std::swap(c.p_WLink, c.p_WScene);
    c.nhat_SL_W = -c.nhat_SL_W;
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_EQ(lied_.of(oracle::Finding::Inconsistent), contacts_);
}

TEST_F(OwnLinksControl, NamesPairsThatNobodyAsked) {
  tellLies([](Pairs& pairs) {
    if (pairs.empty()) return;
    pairs.push_back(pairs.front());
    std::swap(pairs.front().link, pairs.front().other);
  });
  if (IsSkipped() || HasFatalFailure()) return;
  EXPECT_GT(lied_.of(oracle::Finding::Inconsistent), lied_.steps / 2);
}

}  // namespace
}  // namespace foretouch::test
