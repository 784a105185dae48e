// bindings/c/status.h: how a C function reports an error: a status, and a message for
// ft_last_error(). Only the text of an Error allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "articulated/result.h"
#include "bindings/c/include/foretouch/foretouch.h"

/// The format as printf() takes it; on Windows, as its stand-in does.
#ifdef __MINGW_PRINTF_FORMAT
#define FORETOUCH_PRINTF_FORMAT __MINGW_PRINTF_FORMAT
#else
#define FORETOUCH_PRINTF_FORMAT printf
#endif

namespace foretouch::c {

/// Longest message, with its terminating zero; cuts longer ones between characters.
inline constexpr std::size_t kMessageBytes = 1024;

inline constexpr std::int64_t kNoIndex = -1;
/// Stores the message for this thread, prefixed with the current C function's name, and returns
/// `status`. `index`: the joint, link, frame, triangle or body at fault; kNoIndex: none.
[[gnu::format(FORETOUCH_PRINTF_FORMAT, 3, 4)]] ft_status failure(ft_status status,
                                                                 std::int64_t index,
                                                                 const char* format, ...) noexcept;
/// The same for the library's own errors. May throw std::bad_alloc.
ft_status failure(const Error& error);
/// The same for the current exception, in a catch block.
ft_status failureOfException() noexcept;

/// From here on messages begin with `function`, which lives for ever.
void enter(const char* function) noexcept;

[[nodiscard]] ft_status statusOf(ErrorCode code);

/// Runs the body of a C function. No exception leaves it.
template <typename Body>
ft_status guarded(const char* function, const Body& body) noexcept {
  enter(function);
  try {
    return body();
  } catch (...) {
    return failureOfException();
  }
}

/// `name`: the pointer's name in the message.
[[nodiscard]] inline ft_status needed(const void* pointer, const char* name) {
  if (pointer != nullptr) return FT_OK;
  return failure(FT_ERROR_NULL_ARGUMENT, kNoIndex, "expected `%s`, found NULL", name);
}

/// Counts from C may be converted negative numbers.
[[nodiscard]] inline ft_status withinLimit(std::size_t count, std::size_t limit, const char* name) {
  if (count <= limit) return FT_OK;
  return failure(FT_ERROR_LIMIT_EXCEEDED, kNoIndex, "expected at most %zu `%s`, found %zu", limit,
                 name, count);
}

/// An input array: NULL only if empty, and no longer than the limit.
[[nodiscard]] inline ft_status neededArray(const void* array, std::size_t count, std::size_t limit,
                                           const char* name) {
  if (const ft_status status = withinLimit(count, limit, name); status != FT_OK) return status;
  return count == 0 ? ft_status{FT_OK} : needed(array, name);
}

/// Reserved fields.
[[nodiscard]] inline ft_status zero(std::uint32_t reserved, const char* name) {
  if (reserved == 0) return FT_OK;
  return failure(FT_ERROR_STRUCT_SIZE, kNoIndex, "%s: expected 0, found %u", name, reserved);
}

/// An output array. FT_OK with `isAsking` set: the caller only wants the count.
struct Room {
  ft_status status = FT_OK;
  bool isAsking = false;
};
[[nodiscard]] Room roomFor(std::size_t count, const void* array, std::size_t capacity,
                           std::size_t* required, const char* name);

}  // namespace foretouch::c
