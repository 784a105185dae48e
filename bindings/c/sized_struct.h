// bindings/c/sized_struct.h: structs that begin with their size, across versions: fields that an
// older program lacks have their default; fields that a newer one adds must be zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "bindings/c/status.h"

namespace foretouch::c {

/// Sizes are in such words. No struct that any version of the header declares ends within a field:
/// all of them end where their widest field may, which is at eight bytes, or, where pointers have
/// four, at four.
inline constexpr std::size_t kStructWord = sizeof(void*);
static_assert(kStructWord == 8 || kStructWord == 4);

/// No struct will ever be larger; a larger size means that it was never set.
inline constexpr std::size_t kMaxStructSize = 4096;

namespace internal {

[[nodiscard]] ft_status read(const void* given, const char* name, void* known,
                             std::size_t knownSize);
[[nodiscard]] ft_status write(void* given, const char* name, const void* known,
                              std::size_t knownSize);
[[nodiscard]] ft_status init(void* given, std::size_t size, const char* name, const void* defaults,
                             std::size_t knownSize);

}  // namespace internal

/// The size that the struct `given` says it has.
[[nodiscard]] ft_status readSize(const void* given, const char* name, std::size_t& size);

/// Overwrites the fields of `known`, which has the defaults, that `given` holds.
template <typename Struct>
[[nodiscard]] ft_status readStruct(const Struct* given, const char* name, Struct& known) {
  return internal::read(given, name, &known, sizeof(Struct));
}

/// Fills the fields that `given` has room for, except its size; zeroes fields unknown here.
template <typename Struct>
[[nodiscard]] ft_status writeStruct(Struct* given, const char* name, const Struct& known) {
  return internal::write(given, name, &known, sizeof(Struct));
}

/// Writes `count` structs, the i-th from `at(i)`, into an array whose first element's size applies
/// to all. Precondition: there is room.
template <typename Struct, typename At>
[[nodiscard]] ft_status writeStructs(const char* name, std::size_t count, const At& at,
                                     Struct* array) {
  std::size_t stride = 0;
  if (const ft_status status = readSize(array, name, stride); status != FT_OK) return status;
  const auto size = static_cast<std::uint32_t>(stride);
  auto* place = reinterpret_cast<unsigned char*>(array);
  for (std::size_t i = 0; i < count; ++i, place += stride) {
    std::memcpy(place, &size, sizeof size);
    const Struct known = at(i);
    const auto status = writeStruct(reinterpret_cast<Struct*>(place), name, known);
    if (status != FT_OK) return status;
  }
  return FT_OK;
}

/// The same into the array `name` of a caller who may only be asking for the number.
template <typename Struct, typename At>
[[nodiscard]] ft_status writeList(const char* structName, const char* name, std::size_t count,
                                  const At& at, Struct* array, std::size_t capacity,
                                  std::size_t* required) {
  const Room room = roomFor(count, array, capacity, required, name);
  if (room.status != FT_OK || room.isAsking || count == 0) return room.status;
  return writeStructs(structName, count, at, array);
}

/// The body of a struct's ft_*_init().
template <typename Struct>
ft_status initStruct(const char* function, Struct* given, std::size_t size, const char* name,
                     const Struct& defaults) noexcept {
  return guarded(function, [&]() -> ft_status {
    return internal::init(given, size, name, &defaults, sizeof(Struct));
  });
}

}  // namespace foretouch::c
