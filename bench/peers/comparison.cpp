#include "bench/peers/comparison.h"

#include <algorithm>
#include <cmath>

#include "bench/machine.h"
#include "lss/assert.h"

namespace foretouch::tools {
namespace {

/// The value at a share, by nearest rank; zero if there are none.
double atShare(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

void runRound(const MotionSet& set, SweepSolver& solver, SolverRun& run,
              std::vector<std::vector<double>>& usOf) {
  for (std::size_t i = 0; i < set.sweeps.size(); ++i) {
    const ThreadStopwatch watch;
    run.answers[i] = solver.solve(set.sweeps[i]);
    usOf[i].push_back(watch.us());
  }
}

}  // namespace

std::vector<SolverRun> runSolvers(const MotionSet& set, const SweepSolvers& solvers,
                                  const RoundCounts& rounds, const std::function<void()>& tick) {
  FORETOUCH_ASSERT(rounds.own >= 1 && rounds.peers >= 1);
  const std::size_t count = set.sweeps.size();
  std::vector<SolverRun> runs;
  for (const auto& solver : solvers) {
    runs.push_back({solver->name(), solver->isPeer(), std::vector<SweepAnswer>(count), {}});
  }
  std::vector<std::vector<std::vector<double>>> us(solvers.size(),
                                                   std::vector<std::vector<double>>(count));
  for (int round = 0; round < std::max(rounds.own, rounds.peers); ++round) {
    for (std::size_t s = 0; s < solvers.size(); ++s) {
      if (round >= (solvers[s]->isPeer() ? rounds.peers : rounds.own)) continue;
      runRound(set, *solvers[s], runs[s], us[s]);
      tick();
    }
  }
  for (std::size_t s = 0; s < solvers.size(); ++s) {
    for (const auto& ofMotion : us[s]) runs[s].us.push_back(atShare(ofMotion, 0.5));
  }
  return runs;
}

Judgement judged(const MotionSet& set, const SolverRun& run) {
  FORETOUCH_ASSERT(run.answers.size() == set.truths.size());
  Judgement judgement;
  std::vector<double> errors;
  for (std::size_t i = 0; i < set.truths.size(); ++i) {
    const SweepTruth& truth = set.truths[i];
    const SweepAnswer& answer = run.answers[i];
    judgement.contacts += truth.touches ? 1 : 0;
    if (truth.touches && !answer.touches) {
      ++judgement.missed;
      judgement.missedDeep += truth.isDeep ? 1 : 0;
    } else if (!truth.touches && answer.touches) {
      ++judgement.falseHits;
      judgement.falseFar += truth.comesNear ? 0 : 1;
    } else if (truth.touches) {
      errors.push_back(std::abs(answer.toi - truth.toi));
      if (answer.toi <= truth.toi) continue;
      const double after = displacement(set.sweeps[i], truth.toi, answer.toi);
      judgement.latestM = std::max(judgement.latestM, after);
      judgement.late += after > kJudgedDistance ? 1 : 0;
    }
  }
  judgement.medianToiError = atShare(errors, 0.5);
  judgement.p99ToiError = atShare(errors, 0.99);
  judgement.time = figuresOf(run.us);
  return judgement;
}

std::optional<std::size_t> fastestSoundPeer(const std::vector<SolverRun>& runs,
                                            const std::vector<Judgement>& judgements) {
  std::optional<std::size_t> fastest;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].isPeer || !judgements[i].isSound()) continue;
    if (!fastest || judgements[i].time.meanUs < judgements[*fastest].time.meanUs) fastest = i;
  }
  return fastest;
}

}  // namespace foretouch::tools
