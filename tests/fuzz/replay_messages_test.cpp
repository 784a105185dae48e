// The corpora of messages and configurations, with any compiler.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/fuzz/config_inputs.h"
#include "tests/fuzz/message_inputs.h"

namespace foretouch::fuzz {
namespace {

struct Counts {
  int accepted = 0;
  int refused = 0;
};

Counts replay(const std::string& folder, bool (*feed)(const std::uint8_t*, std::size_t)) {
  Counts counts;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FORETOUCH_CORPUS_DIR) + "/" + folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SCOPED_TRACE(entry.path().string());
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    ++(feed(bytes, text.size()) ? counts.accepted : counts.refused);
    // The same with its end missing.
    if (!text.empty()) feed(bytes, text.size() - 1);
  }
  return counts;
}

TEST(FuzzCorpus, MessagesKeepThePromises) {
  EXPECT_GE(replay("skeleton_message", feedSkeletonMessage).accepted, 3);
  EXPECT_GE(replay("pose_message", feedPoseMessage).accepted, 3);
  EXPECT_GE(replay("contacts_message", feedContactsMessage).accepted, 3);
  EXPECT_GE(replay("status_message", feedStatusMessage).accepted, 3);
}

TEST(FuzzCorpus, ConfigurationsKeepThePromises) {
  const Counts counts = replay("config", feedConfig);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 3);
}

}  // namespace
}  // namespace foretouch::fuzz
