// middleware/scene/frozen_array.h: numbers that do not change any more. Not installed.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace foretouch::internal {

/// Its own, or pages of a file that several processes share (scene_image.h). Cheap to copy.
template <typename T>
class FrozenArray {
 public:
  FrozenArray() = default;
  explicit FrozenArray(std::vector<T> own) {
    const auto kept = std::make_shared<const std::vector<T>>(std::move(own));
    data_ = kept->data();
    size_ = kept->size();
    keeper_ = kept;
  }
  /// `keeper` keeps them in memory, aligned as T is.
  FrozenArray(const T* data, std::size_t size, std::shared_ptr<const void> keeper)
      : data_(data), size_(size), keeper_(std::move(keeper)) {}

  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return data_[i]; }
  [[nodiscard]] const T* begin() const { return data_; }
  [[nodiscard]] const T* end() const { return data_ + size_; }

 private:
  const T* data_ = nullptr;
  std::size_t size_ = 0;
  std::shared_ptr<const void> keeper_;
};

}  // namespace foretouch::internal
