// Runs every glTF of the corpus: seeds, and inputs that once failed.
#include "tests/fuzz/gltf_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, GltfFilesKeepThePromises) {
  const CorpusCounts counts = replayCorpus("gltf", feedGltf, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 4);
  EXPECT_GE(counts.refused, 2);
}

}  // namespace
}  // namespace foretouch::fuzz
