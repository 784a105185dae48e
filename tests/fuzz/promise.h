// tests/fuzz/promise.h: invariants for any input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace foretouch::fuzz {

/// Aborts if `condition` is false. Not FORETOUCH_ASSERT: this must hold in every build type.
inline void require(bool condition, const char* promise) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace foretouch::fuzz
