// The corpora of event logs and of damages to one, with any compiler.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/fuzz/log_inputs.h"

namespace foretouch::fuzz {
namespace {

struct Counts {
  int kept = 0, others = 0;
};

/// Every input, and every one of its beginnings.
Counts replay(const std::string& folder, bool (*feed)(const std::uint8_t*, std::size_t)) {
  Counts counts;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FORETOUCH_CORPUS_DIR) + "/" + folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SCOPED_TRACE(entry.path().string());
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    ++(feed(bytes, text.size()) ? counts.kept : counts.others);
    for (std::size_t size = 0; size < text.size(); ++size) feed(bytes, size);
  }
  return counts;
}

TEST(FuzzCorpus, LogsKeepThePromises) {
  const Counts counts = replay("log", feedLog);
  EXPECT_GE(counts.kept, 5);  // giving out nothing would keep every promise, too
  EXPECT_GE(counts.others, 3);
}

TEST(FuzzCorpus, DamagedLogsKeepThePromises) {
  const Counts counts = replay("log_damage", feedLogDamage);
  EXPECT_GE(counts.kept, 2);
  EXPECT_GE(counts.others, 3);
}

}  // namespace
}  // namespace foretouch::fuzz
