// The corpus of datagrams, with any compiler.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tests/fuzz/datagram_inputs.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, DatagramsKeepThePromises) {
  int delivering = 0, others = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FORETOUCH_CORPUS_DIR) + "/datagram")) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SCOPED_TRACE(entry.path().string());
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    ++(feedDatagrams(bytes, text.size()) ? delivering : others);
    // The same with its end missing, at every place.
    for (std::size_t size = 0; size < text.size(); ++size) feedDatagrams(bytes, size);
  }
  EXPECT_GE(delivering, 4);  // delivering nothing would keep every promise, too
  EXPECT_GE(others, 4);
}

}  // namespace
}  // namespace foretouch::fuzz
