#include "bench/extremes/float_mode.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace foretouch::tools::extremes {

#if defined(__SSE2__)

namespace {
constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
}

bool canFlushDenormals() {
  return true;
}
FloatMode::FloatMode(bool flushes) : before_(_mm_getcsr()) {
  constexpr unsigned kBoth = kFlushToZero | kDenormalsAreZero;
  _mm_setcsr(flushes ? before_ | kBoth : before_ & ~kBoth);
}
FloatMode::~FloatMode() {
  _mm_setcsr(before_);
}

#else

bool canFlushDenormals() {
  return false;
}
FloatMode::FloatMode(bool) {}
FloatMode::~FloatMode() = default;

#endif

}  // namespace foretouch::tools::extremes
