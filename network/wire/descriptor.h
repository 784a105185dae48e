// network/wire/descriptor.h: the owner of a file descriptor. Not installed.
#pragma once

#include <utility>

namespace foretouch {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor();
  [[nodiscard]] int get() const { return fd_; }
  /// Somebody else owns it now.
  void release() { fd_ = -1; }

 private:
  int fd_;
};

}  // namespace foretouch
