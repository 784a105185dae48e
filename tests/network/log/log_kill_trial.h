// tests/network/log/log_kill_trial.h: a writer that is killed at a random instant, and what it
// leaves.
#pragma once

#include <cstdint>
#include <string>

namespace foretouch::test {

struct KillTally {
  int trials = 0;
  int unopened = 0;    ///< Killed before the log's first bytes, and before any event was taken.
  int torn = 0;        ///< The log ended within an event.
  int tails = 0;       ///< Whole events after the last check sum.
  int incomplete = 0;  ///< Events were taken that are not given out: the last block's.
  std::uint64_t events = 0;      ///< Given out, each compared with what was written.
  std::uint64_t lostEvents = 0;  ///< Taken, not given out.
  std::uint64_t tailEvents = 0;  ///< Given out by keepTail beyond that.
};

/// One trial in `folder`, with everything drawn from `seed` but the instant, which no seed decides.
/// Empty, or which promise was broken.
std::string runKillTrial(const std::string& folder, std::uint64_t seed, KillTally& tally);

}  // namespace foretouch::test
