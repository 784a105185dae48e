// tests/support/widest_afterwards.h: for tests of all vector widths.
#pragma once

#include <optional>

#include "lss/simd.h"

namespace foretouch::test {

/// Leaves the widest width in use, however the test ends.
struct WidestAfterwards {
  WidestAfterwards() = default;
  WidestAfterwards(const WidestAfterwards&) = delete;
  WidestAfterwards& operator=(const WidestAfterwards&) = delete;
  ~WidestAfterwards() { useSimd(std::nullopt); }
};

}  // namespace foretouch::test
