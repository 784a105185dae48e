// The corpora of event logs and of damages to one, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/log_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, LogsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("log", feedLog, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 5);  // giving out nothing would keep every promise, too
  EXPECT_GE(counts.refused, 3);
}

TEST(FuzzCorpus, DamagedLogsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("log_damage", feedLogDamage, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 2);
  EXPECT_GE(counts.refused, 3);
}

}  // namespace
}  // namespace foretouch::fuzz
