// tests/fuzz/promise.h: invariants for any input.
#pragma once

#include <cstdio>
#include <cstdlib>

#include "articulated/result.h"

namespace foretouch::fuzz {

/// Aborts if `condition` is false. Not FORETOUCH_ASSERT: this must hold in every build type.
inline void require(bool condition, const char* promise) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

inline void checkReason(const Error& error) {
  require(!error.message.empty(), "an error says what is wrong");
  for (const char c : describe(error)) {
    require(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f, "errors can be shown");
  }
}

}  // namespace foretouch::fuzz
