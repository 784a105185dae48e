// assets/import/faults.h: the faults of a damaged file: place, expectation, finding. In
// foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace foretouch::internal {

/// The first few faults of a file, in the order found.
class Faults {
 public:
  /// `place` is a byte, a line or a path of keys; both texts are safe to show.
  void add(const std::string& place, const std::string& what) {
    if (isFull()) return;
    text_ += (text_.empty() ? "" : "; ") + place + ": " + what;
    ++count_;
  }

  [[nodiscard]] bool isFull() const { return count_ == kMost; }
  /// In one sentence; empty if there are none.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  /// One damage often breaks several rules; the first ones are the nearest to the cause.
  static constexpr std::size_t kMost = 3;
  std::size_t count_ = 0;
  std::string text_;
};

[[nodiscard]] inline std::string byteAt(std::uint64_t offset) {
  return "byte " + std::to_string(offset);
}

}  // namespace foretouch::internal
