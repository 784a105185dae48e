#include "bindings/c/status.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace foretouch::c {
namespace {

/// Without constructor and destructor: a thread's last call may come while it ends.
struct LastError {
  const char* function;
  std::int64_t index;
  std::array<char, kMessageBytes> message;
};
thread_local LastError last{"", kNoIndex, {}};

/// Ends the text before a character that was cut in two.
void endBetweenCharacters(char* text) {
  std::size_t end = std::strlen(text);
  if (end + 1 < kMessageBytes) return;
  const auto isContinuation = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  while (end > 0 && isContinuation(text[end - 1])) --end;
  if (end > 0 && (static_cast<unsigned char>(text[end - 1]) & 0x80) != 0) --end;
  text[end] = '\0';
}

}  // namespace

void enter(const char* function) noexcept {
  last.function = function;
}

ft_status failure(ft_status status, std::int64_t index, const char* format, ...) noexcept {
  last.index = index;
  char* const text = last.message.data();
  const int begun = std::snprintf(text, kMessageBytes, "%s: ", last.function);
  const auto start = static_cast<std::size_t>(begun > 0 ? begun : 0);
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text + start, kMessageBytes - start, format, arguments);
  va_end(arguments);
  endBetweenCharacters(text);
  return status;
}

ft_status failure(const Error& error) {
  return failure(statusOf(error.code), error.index, "%s", describe(error).c_str());
}

ft_status failureOfException() noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return failure(FT_ERROR_OUT_OF_MEMORY, kNoIndex, "not enough memory");
  } catch (const std::length_error&) {  // a container that no memory could hold
    return failure(FT_ERROR_OUT_OF_MEMORY, kNoIndex, "not enough memory");
  } catch (const std::exception& exception) {
    return failure(FT_ERROR_INTERNAL, kNoIndex, "unexpected: %s", exception.what());
  } catch (...) {
    return failure(FT_ERROR_INTERNAL, kNoIndex, "unexpected exception");
  }
}

ft_status statusOf(ErrorCode code) {
  switch (code) {
    case ErrorCode::FileNotFound: return FT_ERROR_FILE_NOT_FOUND;
    case ErrorCode::FileUnreadable: return FT_ERROR_FILE_UNREADABLE;
    case ErrorCode::FileUnwritable: return FT_ERROR_FILE_UNWRITABLE;
    case ErrorCode::Syntax: return FT_ERROR_SYNTAX;
    case ErrorCode::LimitExceeded: return FT_ERROR_LIMIT_EXCEEDED;
    case ErrorCode::NonFinite: return FT_ERROR_NON_FINITE;
    case ErrorCode::OutOfRange: return FT_ERROR_OUT_OF_RANGE;
    case ErrorCode::UnknownName: return FT_ERROR_UNKNOWN_NAME;
    case ErrorCode::DuplicateName: return FT_ERROR_DUPLICATE_NAME;
    case ErrorCode::BadHierarchy: return FT_ERROR_BAD_HIERARCHY;
    case ErrorCode::Empty: return FT_ERROR_EMPTY;
    case ErrorCode::Mismatch: return FT_ERROR_MISMATCH;
    case ErrorCode::ImportFailed: return FT_ERROR_IMPORT_FAILED;
    case ErrorCode::ImportCrashed: return FT_ERROR_IMPORT_CRASHED;
    case ErrorCode::DeviceFailed: return FT_ERROR_DEVICE_FAILED;
  }
  return FT_ERROR_INTERNAL;
}

Room roomFor(std::size_t count, const void* array, std::size_t capacity, std::size_t* required,
             const char* name) {
  if (required != nullptr) *required = count;
  if (array == nullptr && capacity == 0) return {FT_OK, true};
  if (const ft_status status = needed(array, name); status != FT_OK) return {status, false};
  if (count <= capacity) return {FT_OK, false};
  return {failure(FT_ERROR_BUFFER_TOO_SMALL, kNoIndex, "expected room for %zu `%s`, found %zu",
                  count, name, capacity),
          false};
}

}  // namespace foretouch::c

const char* ft_status_name(ft_status status) {
  switch (status) {
    case FT_OK: return "ok";
    case FT_ERROR_NULL_ARGUMENT: return "null-argument";
    case FT_ERROR_WRONG_HANDLE: return "wrong-handle";
    case FT_ERROR_STRUCT_SIZE: return "struct-size";
    case FT_ERROR_ABI_VERSION: return "abi-version";
    case FT_ERROR_BUFFER_TOO_SMALL: return "buffer-too-small";
    case FT_ERROR_NO_STEP: return "no-step";
    case FT_ERROR_OUT_OF_MEMORY: return "out-of-memory";
    case FT_ERROR_INTERNAL: return "internal";
    default: break;
  }
  using foretouch::ErrorCode;
  constexpr int kLast = static_cast<int>(ErrorCode::DeviceFailed);
  for (int code = 0; code <= kLast; ++code) {
    const auto known = static_cast<ErrorCode>(code);
    if (foretouch::c::statusOf(known) == status) return foretouch::toString(known);
  }
  return "unknown";
}

const char* ft_last_error(void) {
  return foretouch::c::last.message.data();
}

int64_t ft_last_error_index(void) {
  return foretouch::c::last.index;
}

const char* ft_version(void) {
  return FORETOUCH_VERSION;
}

uint32_t ft_abi_version(void) {
  return FT_ABI_VERSION;
}

ft_status ft_check_abi(uint32_t header_version) {
  using foretouch::c::failure;
  foretouch::c::enter(__func__);
  if (header_version <= FT_ABI_VERSION) return FT_OK;
  return failure(FT_ERROR_ABI_VERSION, foretouch::c::kNoIndex,
                 "the program was built for version %u of the binary interface; expected at most "
                 "%d, which libforetouch %s has",
                 header_version, FT_ABI_VERSION, ft_version());
}
