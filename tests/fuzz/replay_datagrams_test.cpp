// The corpus of datagrams, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/datagram_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, DatagramsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("datagram", feedDatagrams, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 4);  // delivering nothing would keep every promise, too
  EXPECT_GE(counts.refused, 4);
}

}  // namespace
}  // namespace foretouch::fuzz
