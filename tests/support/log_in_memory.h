// tests/support/log_in_memory.h: an event log that no file holds.
#pragma once

#include <cstring>
#include <memory>
#include <utility>

#include "network/log/event_log_reader_access.h"

namespace foretouch::test {

class MemoryBytes : public LogBytes {
 public:
  explicit MemoryBytes(Bytes bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  Result<Done> read(std::uint64_t offset, std::uint8_t* bytes, std::size_t count) override {
    std::memcpy(bytes, bytes_.data() + offset, count);
    return Done{};
  }

 private:
  Bytes bytes_;
};

inline std::unique_ptr<LogBytes> logInMemory(Bytes bytes) {
  return std::make_unique<MemoryBytes>(std::move(bytes));
}

}  // namespace foretouch::test
