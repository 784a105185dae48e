// tests/mutants/switch.h: which of the mutants that are compiled in is on (mutants.py). Included
// before everything else of the mutants' build.
#pragma once

#include <cstdlib>

namespace foretouch_mutants {

inline constexpr int kMost = 1 << 14;
inline int chosen = -2;  // -2: nobody has asked yet
inline unsigned char reached[kMost];

/// Asked where mutant `k` differs from what is written there.
inline bool on(int k) {
  if (chosen == -2) {
    const char* const text = std::getenv("FORETOUCH_MUTANT");
    chosen = text != nullptr ? std::atoi(text) : -1;
  }
  reached[k] = 1;
  return k == chosen;
}

}  // namespace foretouch_mutants
