// Every input of the corpus, with any compiler: seeds, and what fuzzing once broke.
#include "tests/fuzz/replay_corpus.h"

#include <gtest/gtest.h>

#include "tests/fuzz/baked_inputs.h"
#include "tests/fuzz/fuzz_inputs.h"
#include "tests/fuzz/import_inputs.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, BvhInputsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("bvh", feedBvh);
  EXPECT_GE(counts.accepted, 4);  // refusing everything would keep every promise, too
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, AvatarInputsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("avatar", feedAvatar);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, PairRulesKeepThePromises) {
  const CorpusCounts counts = replayCorpus("pairs", feedPairs, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 3);
}

TEST(FuzzCorpus, BakedScenesKeepThePromises) {
  const CorpusCounts counts =
      replayCorpus("baked_scene", feedBakedScene, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 2);
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, ImportersAnswersKeepThePromises) {
  const CorpusCounts counts =
      replayCorpus("import_stream", feedImportStream, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 2);
  EXPECT_GE(counts.refused, 4);
}

}  // namespace
}  // namespace foretouch::fuzz
