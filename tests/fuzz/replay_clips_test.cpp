// The corpora of clips of motion research, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/clip_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, AcclaimKeepsThePromises) {
  const CorpusCounts counts = replayCorpus("acclaim", feedAcclaim, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 2);
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, WebXrKeepsThePromises) {
  const CorpusCounts counts = replayCorpus("webxr", feedWebXr, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 1);
  EXPECT_GE(counts.refused, 2);
}

}  // namespace
}  // namespace foretouch::fuzz
