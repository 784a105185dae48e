// lss/prefetch.h: asks for memory before it is needed, so that it arrives while other work goes on.
// Only speed depends on it. Not installed.
#pragma once

#include <cstddef>

#include <hwy/cache_control.h>

namespace foretouch::internal {

/// All cache lines of `bytes` bytes from `memory` on, which need not be valid.
inline void prefetch(const void* memory, std::size_t bytes) {
  constexpr std::size_t kCacheLine = 64;
  const char* const first = static_cast<const char*>(memory);
  for (std::size_t byte = 0; byte < bytes; byte += kCacheLine) hwy::Prefetch(first + byte);
  hwy::Prefetch(first + bytes - 1);
}

}  // namespace foretouch::internal
