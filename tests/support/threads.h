// tests/support/threads.h: tests of threads run where there are threads. WebAssembly has them only
// where it is built to share its memory.
#pragma once

namespace foretouch::test {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
inline constexpr bool kHasThreads = false;
#else
inline constexpr bool kHasThreads = true;
#endif

}  // namespace foretouch::test
