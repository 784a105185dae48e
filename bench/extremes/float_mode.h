// bench/extremes/float_mode.h: whether this thread's vectors flush denormals to zero, as in game
// engines and audio programs (x86: FTZ and DAZ of MXCSR).
#pragma once

namespace foretouch::tools::extremes {

/// True if this processor has such a mode.
[[nodiscard]] bool canFlushDenormals();

/// While it lives, this thread flushes denormals (results and operands), or keeps them.
class FloatMode {
 public:
  explicit FloatMode(bool flushes);
  ~FloatMode();
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  unsigned before_ = 0;
};

}  // namespace foretouch::tools::extremes
