// The corpus of calls of the C library, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/call_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, CallsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("calls", feedCalls, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 1);
  EXPECT_GE(counts.refused, 1);
}

}  // namespace
}  // namespace foretouch::fuzz
