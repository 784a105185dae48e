// tests/fuzz/replay_corpus.h: runs every input of a corpus folder, with any compiler: seeds, and
// inputs that once failed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace foretouch::fuzz {

struct CorpusCounts {
  int accepted = 0, refused = 0;
};

/// Further inputs made from one.
enum class AlsoFeed : std::uint8_t { Nothing, LastByteMissing, EveryBeginning };

inline CorpusCounts replayCorpus(const std::string& folder,
                                 bool (*feed)(const std::uint8_t*, std::size_t),
                                 AlsoFeed also = AlsoFeed::Nothing) {
  CorpusCounts counts;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(FORETOUCH_CORPUS_DIR) + "/" + folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    SCOPED_TRACE(entry.path().string());
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(text.data());
    ++(feed(bytes, text.size()) ? counts.accepted : counts.refused);
    if (also == AlsoFeed::LastByteMissing && !text.empty()) feed(bytes, text.size() - 1);
    if (also != AlsoFeed::EveryBeginning) continue;
    for (std::size_t size = 0; size < text.size(); ++size) feed(bytes, size);
  }
  return counts;
}

}  // namespace foretouch::fuzz
