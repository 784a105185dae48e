// The corpora of manifests and certificates, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/batch_inputs.h"
#include "tests/fuzz/certificate_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, ManifestsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("manifest", feedManifest, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 1);
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, CertificatesKeepThePromises) {
  const CorpusCounts counts =
      replayCorpus("certificate", feedCertificate, AlsoFeed::EveryBeginning);
  EXPECT_GE(counts.accepted, 1);
  EXPECT_GE(counts.refused, 3);
}

}  // namespace
}  // namespace foretouch::fuzz
