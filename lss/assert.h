// lss/assert.h: checks for our own mistakes, on in Debug and RelWithDebInfo (FORETOUCH_CHECKS). Bad
// input never reaches these: it is an Error (articulated/result.h). Neither does geometry: "cannot
// tell" is a verdict.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace foretouch::internal {

[[noreturn]] inline void assertionFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: broken invariant: %s\n", file, line, condition);
  std::abort();
}

}  // namespace foretouch::internal

#if defined(FORETOUCH_CHECKS) && FORETOUCH_CHECKS
#define FORETOUCH_ASSERT(condition) \
  ((condition) ? (void)0 : ::foretouch::internal::assertionFailed(#condition, __FILE__, __LINE__))
#else
#define FORETOUCH_ASSERT(condition) ((void)sizeof((condition) ? 1 : 0))
#endif
