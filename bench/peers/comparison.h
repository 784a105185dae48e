// bench/peers/comparison.h: solvers on a set of motions: their answers compared with the truth, and
// their times. Microseconds of the thread's CPU time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/leaf_timing.h"
#include "bench/peers/motion_sets.h"
#include "bench/peers/sweep_solver.h"

namespace foretouch::tools {

/// A solver's answers and times, one per motion of the set.
struct SolverRun {
  std::string name;
  bool isPeer = false;
  std::vector<SweepAnswer> answers;
  std::vector<double> us;  ///< The median of the rounds, less the cost of reading the clock.
};

struct RoundCounts {
  int own = 3, peers = 1;  ///< At least 1 each.
};

/// Runs every solver on every motion, round by round and solver by solver, so that a drift of the
/// machine affects all of them; peers skip the rounds beyond theirs. Calls `tick` after each
/// solver's round.
[[nodiscard]] std::vector<SolverRun> runSolvers(const MotionSet& set, const SweepSolvers& solvers,
                                                const RoundCounts& rounds,
                                                const std::function<void()>& tick);

/// A run compared with the truth. Errors of the time of impact are in units of t, for motions on
/// which solver and truth agree that there is a contact.
struct Judgement {
  std::size_t contacts = 0;    ///< In truth.
  std::size_t missed = 0;      ///< Contacts that the solver does not report,
  std::size_t missedDeep = 0;  ///< and those of them that go deeper than kJudgedDistance.
  std::size_t late = 0;        ///< Reported more than kJudgedDistance of motion after the contact.
  std::size_t falseHits = 0;   ///< Contacts reported on free motions,
  std::size_t falseFar = 0;    ///< and those of them that never come within kJudgedDistance.
  double medianToiError = 0.0, p99ToiError = 0.0;
  double latestM =
      0.0;  ///< The most motion after a contact at which it was reported (m); 0: never.
  TimeFigures time;

  /// Misses nothing and is never late: usable by users who need contacts.
  [[nodiscard]] bool isSound() const { return missed == 0 && late == 0; }
};

[[nodiscard]] Judgement judged(const MotionSet& set, const SolverRun& run);

/// The index of the sound peer with the least mean time; nothing if no peer is sound.
[[nodiscard]] std::optional<std::size_t> fastestSoundPeer(const std::vector<SolverRun>& runs,
                                                          const std::vector<Judgement>& judgements);

}  // namespace foretouch::tools
