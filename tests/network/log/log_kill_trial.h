// tests/network/log/log_kill_trial.h: kills a writer at a random instant, and checks its log.
#pragma once

#include <cstdint>
#include <string>

namespace foretouch::test {

struct KillTally {
  int trials = 0;
  int unopened = 0;          ///< Killed before the log's first bytes, and before it took any event.
  int torn = 0;              ///< The log ended within an event.
  int tails = 0;             ///< Whole events after the last check sum.
  int incomplete = 0;        ///< Events taken but not returned: the last block's.
  std::uint64_t events = 0;  ///< Returned, each compared with the written one.
  std::uint64_t lostEvents = 0;  ///< Taken, not returned.
  std::uint64_t tailEvents = 0;  ///< Returned additionally by keepTail.
};

/// One trial in `folder`, with everything drawn from `seed` except the instant. Empty, or the
/// broken promise.
std::string runKillTrial(const std::string& folder, std::uint64_t seed, KillTally& tally);

}  // namespace foretouch::test
