// tests/fuzz/promise.h: what must hold of any input.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace foretouch::fuzz {

/// Aborts where it does not hold. Not FORETOUCH_ASSERT: this must hold in every build type.
inline void require(bool condition, const char* promise) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace foretouch::fuzz
