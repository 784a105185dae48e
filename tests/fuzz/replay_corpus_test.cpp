// Every input of the corpus, with any compiler: seeds, and what fuzzing once broke.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/fuzz/fuzz_inputs.h"

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
    const bool accepted = feed(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    ++(accepted ? counts.accepted : counts.refused);
  }
  return counts;
}

TEST(FuzzCorpus, BvhInputsKeepThePromises) {
  const Counts counts = replay("bvh", feedBvh);
  EXPECT_GE(counts.accepted, 4);  // refusing everything would keep every promise, too
  EXPECT_GE(counts.refused, 2);
}

TEST(FuzzCorpus, AvatarInputsKeepThePromises) {
  const Counts counts = replay("avatar", feedAvatar);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 2);
}

}  // namespace
}  // namespace foretouch::fuzz
