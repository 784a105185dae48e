// lss/sanitizer.h: is this build one with a sanitizer, or one that counts which lines are run, whose
// runtime writes files as well? Not installed.
#pragma once

namespace foretouch::internal {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(FORETOUCH_COUNTED)
inline constexpr bool kUnderSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kUnderSanitizer = true;
#else
inline constexpr bool kUnderSanitizer = false;
#endif
#else
inline constexpr bool kUnderSanitizer = false;
#endif

}  // namespace foretouch::internal
