// log_kill_trials [N] [SEED]: N writers of event logs killed at random instants (1,000), each log
// read back and compared. Exit code 1 where a promise was broken.
#include <cstdio>
#include <cstdlib>

#include "tests/network/log/log_kill_trial.h"
#include "tests/support/temp_folder.h"

int main(int argc, char** argv) {
  using namespace foretouch::test;
  const int trials = argc > 1 ? std::atoi(argv[1]) : 1'000;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  const TempFolder folder;
  KillTally tally;
  int broken = 0;
  for (int i = 0; i < trials; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const std::string why = runKillTrial(folder.path(), seed, tally);
    if (why.empty()) continue;
    ++broken;
    std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed), why.c_str());
  }
  std::printf(
      "%d kills, %d broken promises\n"
      "  %d before the log had begun; in %d it ended within an event, in %d whole events followed "
      "the"
      " last check sum\n"
      "  %llu events given out, each as it was written; %llu taken and not given out, in %d logs, "
      "never"
      " more than the last block; %llu of them as a tail\n",
      tally.trials, broken, tally.unopened, tally.torn, tally.tails,
      static_cast<unsigned long long>(tally.events),
      static_cast<unsigned long long>(tally.lostEvents), tally.incomplete,
      static_cast<unsigned long long>(tally.tailEvents));
  return broken == 0 && tally.trials == trials ? 0 : 1;
}
