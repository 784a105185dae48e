// tests/fuzz/promise.h: invariants for any input.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

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

/// Of a reader of `text`, which was told that it comes from the file "input".
inline void checkError(const Error& error, std::string_view text) {
  checkReason(error);
  require(error.file == "input", "an error names its file");
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  require(error.line == -1 || (error.line >= 1 && error.line <= lines), "an error's line exists");
}

}  // namespace foretouch::fuzz
