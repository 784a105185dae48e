// tests/bindings/random_caller.h: what callers of the C library get wrong, drawn at random: NULL,
// handles of other kinds, NaN, counts that are no counts, sizes of structs that were never set,
// indices out of range. Arrays are as long as the largest count that is not refused for being too
// large.
#pragma once

#include <array>
#include <cstdint>
#include <foretouch/foretouch.h>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::test {

class RandomCaller {
 public:
  [[nodiscard]] int accepted() const { return accepted_; }
  [[nodiscard]] int refused() const { return refused_; }

 protected:
  static constexpr std::size_t kRoom = 8;

  explicit RandomCaller(std::uint64_t seed) : random_(seed) {}

  double number() {
    switch (random_.below(8)) {
      case 0: return std::numeric_limits<double>::quiet_NaN();
      case 1: return std::numeric_limits<double>::infinity();
      case 2: return 1e300;
      case 3: return -1.0;
      case 4: return 0.0;
      default: return random_.uniform(0.0, 1.0);
    }
  }
  std::int32_t index() {
    constexpr std::array<std::int32_t, 8> kIndices = {
        0, 0, 0, 1, 2, -1, 1 << 30, std::numeric_limits<std::int32_t>::min()};
    return kIndices[static_cast<std::size_t>(random_.below(8))];
  }
  /// Never between kRoom and what is refused.
  std::size_t count() {
    if (random_.chance(0.1)) return static_cast<std::size_t>(-random_.below(5) - 1);
    return static_cast<std::size_t>(random_.below(4));
  }
  std::uint32_t sizeOr(std::size_t right) {
    if (random_.chance(0.8)) return static_cast<std::uint32_t>(right);
    constexpr std::array<std::uint32_t, 6> kSizes = {0, 4, 7, 8, 16, 0xffffffffu};
    return kSizes[static_cast<std::size_t>(random_.below(6))];
  }
  template <typename T>
  T* maybe(T* pointer) {
    return random_.chance(0.1) ? nullptr : pointer;
  }
  void take(ft_status status) {
    EXPECT_STRNE(ft_status_name(status), "unknown") << status;
    EXPECT_NE(status, FT_ERROR_INTERNAL) << ft_last_error();
    if (status != FT_OK) {
      EXPECT_STRNE(ft_last_error(), "");
    }
    (status == FT_OK ? accepted_ : refused_) += 1;
  }
  template <typename Handle>
  void takeHandle(ft_status status, Handle*& handle, void (*release)(Handle*)) {
    take(status);
    EXPECT_EQ(handle != nullptr, status == FT_OK);
    release(handle);
  }
  void fillNumbers() {
    const bool isTame = random_.chance(0.5);
    for (double& value : numbers_) value = isTame ? random_.uniform(-1.0, 1.0) : number();
    for (std::size_t q = 0; isTame && q + 4 <= numbers_.size(); q += 4) {
      if (random_.chance(0.7))
        numbers_[q] = 1.0, numbers_[q + 1] = numbers_[q + 2] = numbers_[q + 3] = 0.0;
    }
    for (std::int32_t& i : indices_) i = isTame ? random_.below(2) : index();
  }

  Random random_;
  std::array<double, 8 * kRoom> numbers_{};
  std::array<std::int32_t, kRoom> indices_{};
  std::array<ft_ignored_pair, kRoom> ignored_{};
  std::array<const char*, kRoom> names_ = {"stick", "b", "\xff", "", nullptr, "f", "g", "h"};

 private:
  int accepted_ = 0, refused_ = 0;
};

}  // namespace foretouch::test
