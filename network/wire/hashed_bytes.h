// network/wire/hashed_bytes.h: numbers and texts as the bytes of a hash that is the same on every
// machine. For sources only.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include <Eigen/Core>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace foretouch {

/// Integers and doubles little-endian. The hash is XXH64 with the seed 0.
class HashedBytes {
 public:
  void add(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8) {
      bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(word >> shift)));
    }
  }
  void add(double number) {
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof word);
    add(word);
  }
  void add(const Eigen::Vector3d& point) {
    for (int i = 0; i < 3; ++i) add(point[i]);
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  [[nodiscard]] std::int64_t hash() const {
    return static_cast<std::int64_t>(XXH64(bytes_.data(), bytes_.size(), 0));
  }

 private:
  std::string bytes_;
};

}  // namespace foretouch
