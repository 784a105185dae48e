// How solvers are run and judged by `bench peers`.
#include "bench/peers.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/tools/random_clutter.h"

namespace foretouch::test {
namespace {

using tools::ComparedSet;
using tools::Judgement;
using tools::MotionSet;
using tools::SolverRun;
using tools::SweepTruth;

/// Four motions of 0.5 m along x: two in contact halfway, one that comes near, one far from all.
MotionSet fourMotions() {
  MotionSet set;
  tools::RigidSweep sweep;
  sweep.lss_L = {Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 0, 0.3), 0.06};
  sweep.to = Eigen::Vector3d(0.5, 0, 0);
  set.name = "made up";
  set.lss_L = sweep.lss_L;
  set.sweeps.assign(4, sweep);
  set.truths = {SweepTruth{true, 0.5, true, true}, SweepTruth{true, 0.5, false, true},
                SweepTruth{false, 1.0, false, true}, SweepTruth{false, 1.0, false, false}};
  return set;
}

TEST(Judged, CountsWhatAUserWouldMind) {
  const MotionSet set = fourMotions();
  const SolverRun blind{"blind", true, {{}, {}, {}, {}}, {1, 2, 3, 4}};
  const Judgement missing = judged(set, blind);
  EXPECT_EQ(missing.contacts, 2u);
  EXPECT_EQ(missing.missed, 2u);
  EXPECT_EQ(missing.missedDeep, 1u);
  EXPECT_EQ(missing.falseHits, 0u);
  EXPECT_EQ(missing.time.medianUs, 2.0);
  EXPECT_EQ(missing.time.meanUs, 2.5);
  EXPECT_FALSE(missing.isSound());

  const SolverRun eager{
      "eager", true, {{true, 0}, {true, 0.4}, {true, 0}, {true, 0}}, {1, 1, 1, 1}};
  const Judgement early = judged(set, eager);
  EXPECT_EQ(early.missed, 0u);
  EXPECT_EQ(early.late, 0u);
  EXPECT_EQ(early.falseHits, 2u);
  EXPECT_EQ(early.falseFar, 1u);
  EXPECT_NEAR(early.medianToiError, 0.1, 1e-12);
  EXPECT_NEAR(early.p99ToiError, 0.5, 1e-12);
  EXPECT_EQ(early.latestM, 0.0);
  EXPECT_TRUE(early.isSound());

  const SolverRun slack{"slack", true, {{true, 0.501}, {true, 0.503}, {}, {}}, {1, 1, 1, 1}};
  const Judgement late = judged(set, slack);
  EXPECT_EQ(late.late, 1u);  // 1.5 mm of motion; the other's half a millimetre is let pass
  EXPECT_NEAR(late.latestM, 1.5e-3, 1e-12);
  EXPECT_FALSE(late.isSound());
}

TEST(FastestSoundPeer, IsNoUnsoundOneAndNotOurs) {
  std::vector<SolverRun> runs = {{"ours", false, {}, {}},
                                 {"slow", true, {}, {}},
                                 {"fast", true, {}, {}},
                                 {"blind", true, {}, {}}};
  std::vector<Judgement> judgements(4);
  const double means[] = {1, 9, 5, 2};
  for (std::size_t i = 0; i < 4; ++i) judgements[i].time.meanUs = means[i];
  judgements[3].missed = 1;
  EXPECT_EQ(fastestSoundPeer(runs, judgements), std::size_t{2});
  judgements[1].late = judgements[2].late = 1;
  EXPECT_FALSE(fastestSoundPeer(runs, judgements).has_value());
}

class CountingSolver : public tools::SweepSolver {
 public:
  CountingSolver(bool isPeer, int& calls)
      : SweepSolver(isPeer ? "peer" : "own", isPeer), calls_(calls) {}
  tools::SweepAnswer solve(const tools::RigidSweep&) override {
    ++calls_;
    return {true, 0.25};
  }

 private:
  int& calls_;
};

TEST(RunSolvers, AsksEveryMotionInEveryRound) {
  int own = 0, peer = 0, ticks = 0;
  tools::SweepSolvers solvers;
  solvers.push_back(std::make_unique<CountingSolver>(false, own));
  solvers.push_back(std::make_unique<CountingSolver>(true, peer));
  const auto runs = runSolvers(fourMotions(), solvers, {3, 2}, [&] { ++ticks; });
  EXPECT_EQ(own, 12);
  EXPECT_EQ(peer, 8);
  EXPECT_EQ(ticks, 5);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_TRUE(runs[1].isPeer);
  EXPECT_EQ(runs[1].answers.size(), 4u);
  EXPECT_EQ(runs[1].answers[3].toi, 0.25);
  EXPECT_EQ(runs[1].us.size(), 4u);
}

class ComparedPeers : public testing::Test {
 protected:
  static const std::vector<ComparedSet>& sets() {
    static const std::vector<ComparedSet> sets = [] {
      tools::PeersPlan plan;
      plan.sets.assign(tools::kMotionSets.begin(), tools::kMotionSets.end());
      plan.motions = 40;
      plan.rounds = {1, 1};
      return tools::comparePeers(clutterScene(400, 5), plan, [](auto, auto) {}).value();
    }();
    return sets;
  }
  /// Calls `check` with every run whose name starts so; how many there were.
  template <typename Check>
  static int forRuns(const std::string& prefix, const Check& check) {
    int found = 0;
    for (const ComparedSet& set : sets()) {
      for (std::size_t i = 0; i < set.runs.size(); ++i) {
        if (set.runs[i].name.rfind(prefix, 0) != 0) continue;
        SCOPED_TRACE(set.motions.name + ": " + set.runs[i].name);
        check(set, set.runs[i], set.judgements[i]);
        ++found;
      }
    }
    return found;
  }
};

TEST_F(ComparedPeers, ForetouchMissesNothingAndIsNeverLate) {
  EXPECT_EQ(tools::brokenPromises(sets()), 0u);
  const int runs =
      forRuns("Foretouch", [](const ComparedSet& set, const SolverRun& run, const Judgement& j) {
        EXPECT_EQ(j.contacts, 20u);
        EXPECT_EQ(j.missed + j.late + j.falseFar, 0u);
        for (std::size_t i = 0; i < run.answers.size(); ++i) {
          if (!set.motions.truths[i].touches) continue;
          // The truth itself is early by no more than its own separation at the slowest approach.
          EXPECT_LE(run.answers[i].toi, set.motions.truths[i].toi + 1e-5) << i;
          EXPECT_GT(run.answers[i].toi, 0.0) << i;
        }
      });
  EXPECT_EQ(runs, 9);
}

TEST_F(ComparedPeers, FinerTolerancesComeCloserToTheTruth) {
  for (const ComparedSet& set : sets()) {
    EXPECT_LT(set.judgements[1].medianToiError, set.judgements[0].medianToiError);
    EXPECT_LT(set.judgements[2].medianToiError, set.judgements[1].medianToiError);
    EXPECT_LT(set.judgements[2].medianToiError, 1e-4);
  }
}

// By libccd: FCL's own GJK has its lapses. That it does shows that peers are told the same motions
// in the same scene.
TEST_F(ComparedPeers, AdvancementAroundFclFindsEveryContact) {
  if (!tools::hasPeers()) GTEST_SKIP() << "built without FCL and Bullet";
  EXPECT_EQ(forRuns("FCL distance (libccd",
                    [](const ComparedSet&, const SolverRun&, const Judgement& j) {
                      EXPECT_EQ(j.missed + j.late + j.falseFar, 0u);
                      EXPECT_LT(j.medianToiError, 0.02);
                    }),
            12);
}

TEST_F(ComparedPeers, BulletInPiecesFindsContactsWhereTheyAre) {
  if (!tools::hasPeers()) GTEST_SKIP() << "built without FCL and Bullet";
  EXPECT_EQ(forRuns("Bullet cast of each triangle, pieces",
                    [](const ComparedSet&, const SolverRun&, const Judgement& j) {
                      EXPECT_LT(j.missed, j.contacts / 4);
                      EXPECT_LT(j.medianToiError, 0.02);
                    }),
            6);
}

// The control: poses tested one after another are late by what lies between them.
TEST_F(ComparedPeers, SamplingIsLate) {
  if (!tools::hasPeers()) GTEST_SKIP() << "built without FCL and Bullet";
  const auto isLate = [](const ComparedSet&, const SolverRun&, const Judgement& j) {
    EXPECT_GT(j.late + j.missed, j.contacts / 2);
    EXPECT_LT(j.p99ToiError, 0.6);
  };
  EXPECT_EQ(forRuns("FCL continuousCollide, 10 ", isLate), 3);
  EXPECT_EQ(forRuns("FCL collide, 10 ", isLate), 3);
}

TEST_F(ComparedPeers, FillTheTables) {
  const auto tables = tools::peerTables(sets());
  ASSERT_GE(tables.size(), 4u);
  EXPECT_EQ(tables[0].name, "s1");
  for (const auto& table : tables) {
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  }
  std::size_t rows = 0;
  for (const ComparedSet& set : sets()) rows += 40 * set.runs.size();
  EXPECT_EQ(tools::rawPeerTable(sets()).rows.size(), rows);
  EXPECT_EQ(tables.back().rows.empty(), !tools::hasPeers());
}

}  // namespace
}  // namespace foretouch::test
