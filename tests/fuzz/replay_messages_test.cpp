// The corpora of messages and configurations, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/config_inputs.h"
#include "tests/fuzz/message_inputs.h"
#include "tests/fuzz/replay_corpus.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, MessagesKeepThePromises) {
  EXPECT_GE(
      replayCorpus("skeleton_message", feedSkeletonMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(replayCorpus("pose_message", feedPoseMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(
      replayCorpus("contacts_message", feedContactsMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(replayCorpus("status_message", feedStatusMessage, AlsoFeed::LastByteMissing).accepted,
            3);
}

TEST(FuzzCorpus, ConfigurationsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("config", feedConfig, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 3);
}

}  // namespace
}  // namespace foretouch::fuzz
