// middleware/solid/pose_list.h: poses in order, whose memory stays. Not installed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "articulated/skeleton.h"

namespace foretouch::internal {

class PoseList {
 public:
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] const Pose& operator[](std::size_t i) const { return poses_[i]; }
  [[nodiscard]] const Pose& back() const { return poses_[count_ - 1]; }

  void clear() { count_ = 0; }
  void push(const Pose& pose) {
    if (poses_.size() == count_) poses_.emplace_back();
    poses_[count_++] = pose;
  }
  /// Appends those of `from` in [first, end).
  void push(const PoseList& from, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) push(from[i]);
  }
  /// Keeps memory for so many poses of this size.
  void reserve(std::size_t count, const Pose& pose) { poses_.assign(count, pose); }
  /// Only the first ones stay. Precondition: count <= size().
  void shorten(std::size_t count) { count_ = count; }
  /// Every second one stays, from the first one on.
  void thin() {
    for (std::size_t i = 1; 2 * i < count_; ++i) std::swap(poses_[i], poses_[2 * i]);
    count_ = (count_ + 1) / 2;
  }
  /// The first ones go. Precondition: count <= size().
  void dropFirst(std::size_t count) {
    std::rotate(poses_.begin(), poses_.begin() + static_cast<std::ptrdiff_t>(count),
                poses_.begin() + static_cast<std::ptrdiff_t>(count_));
    count_ -= count;
  }
  void reverse() {
    std::reverse(poses_.begin(), poses_.begin() + static_cast<std::ptrdiff_t>(count_));
  }
  void swap(PoseList& other) {
    poses_.swap(other.poses_);
    std::swap(count_, other.count_);
  }

 private:
  std::vector<Pose> poses_;  // longer than the count
  std::size_t count_ = 0;
};

}  // namespace foretouch::internal
