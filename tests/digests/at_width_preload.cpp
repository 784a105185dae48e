// tests/digests/at_width_preload.cpp: loaded before a program that uses the C library or the Python
// package (LD_PRELOAD), gives it the vectors of the width that FORETOUCH_AT_WIDTH names. Neither
// has a way to ask for them, and both have the vectors' dispatcher as a library of its own.
#include <cstdio>
#include <cstdlib>

#include "lss/simd.h"

namespace {

struct AtWidth {
  AtWidth() {
    const char* const name = std::getenv("FORETOUCH_AT_WIDTH");
    const auto simd = name != nullptr ? foretouch::simdFromName(name) : std::nullopt;
    if (simd && foretouch::useSimd(simd)) return;
    std::fputs("FORETOUCH_AT_WIDTH: expected vectors that this processor has\n", stderr);
    std::exit(2);
  }
} const atWidth;

}  // namespace
