// lss/extended_precision.h: a long double that has the digits that we count on. On x86-64 it has 64
// bits only while the processor's control word says so, and the host sets that: Mono, which is
// Unity's, and programs of Microsoft's compiler set it to 53.
#pragma once

#include <cstdint>

namespace foretouch::internal {

/// While it lives, this thread's long double has all its digits. On processors other than x86 it
/// always has.
class ExtendedPrecision {
 public:
  ExtendedPrecision(const ExtendedPrecision&) = delete;
  ExtendedPrecision& operator=(const ExtendedPrecision&) = delete;

#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
  ExtendedPrecision() {
    __asm__ __volatile__("fnstcw %0" : "=m"(found_));
    constexpr std::uint16_t kDigits = 0x300;  // the field that says how many; all set: 64
    const auto all = static_cast<std::uint16_t>(found_ | kDigits);
    __asm__ __volatile__("fldcw %0" : : "m"(all) : "memory");
  }
  ~ExtendedPrecision() {
    __asm__ __volatile__("fldcw %0" : : "m"(found_) : "memory");
  }

 private:
  std::uint16_t found_ = 0;
#else
  ExtendedPrecision() {}
  ~ExtendedPrecision() {}
#endif
};

}  // namespace foretouch::internal
