// bench/extremes/float_mode.h: whether this thread's vectors flush denormals to zero, as game
// engines and audio programs set it (x86: FTZ and DAZ of MXCSR).
#pragma once

namespace foretouch::tools::extremes {

/// This processor has such a mode.
[[nodiscard]] bool canFlushDenormals();

/// While it lives, denormals are flushed (results and operands) in this thread, or are not.
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
