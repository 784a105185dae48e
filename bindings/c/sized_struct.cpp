#include "bindings/c/sized_struct.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace foretouch::c {
namespace {

using Size = std::uint32_t;

ft_status checkedSize(std::size_t size, const char* name) {
  if (size >= kStructWord && size <= kMaxStructSize && size % kStructWord == 0) return FT_OK;
  return failure(
      FT_ERROR_STRUCT_SIZE, kNoIndex,
      "%s: expected its size in bytes in the first field, found %zu; was it initialised?", name,
      size);
}

}  // namespace

ft_status readSize(const void* given, const char* name, std::size_t& size) {
  if (const ft_status status = needed(given, name); status != FT_OK) return status;
  Size said = 0;
  std::memcpy(&said, given, sizeof said);
  size = said;
  return checkedSize(size, name);
}

namespace internal {

ft_status read(const void* given, const char* name, void* known, std::size_t knownSize) {
  std::size_t size = 0;
  if (const ft_status status = readSize(given, name, size); status != FT_OK) return status;
  const auto* const bytes = static_cast<const unsigned char*>(given);
  for (std::size_t i = knownSize; i < size; ++i) {
    if (bytes[i] == 0) continue;
    return failure(FT_ERROR_STRUCT_SIZE, kNoIndex,
                   "%s: the program sets a field that libforetouch %s does not know (byte %zu of "
                   "%zu); expected zero there",
                   name, ft_version(), i, size);
  }
  std::memcpy(known, given, std::min(size, knownSize));
  return FT_OK;
}

ft_status write(void* given, const char* name, const void* known, std::size_t knownSize) {
  std::size_t size = 0;
  if (const ft_status status = readSize(given, name, size); status != FT_OK) return status;
  auto* const bytes = static_cast<unsigned char*>(given);
  const auto* const from = static_cast<const unsigned char*>(known);
  const std::size_t end = std::min(size, knownSize);
  std::memcpy(bytes + sizeof(Size), from + sizeof(Size), end - sizeof(Size));
  std::memset(bytes + end, 0, size - end);
  return FT_OK;
}

ft_status init(void* given, std::size_t size, const char* name, const void* defaults,
               std::size_t knownSize) {
  if (const ft_status status = needed(given, name); status != FT_OK) return status;
  if (const ft_status status = checkedSize(size, name); status != FT_OK) return status;
  const auto said = static_cast<Size>(size);
  std::memcpy(given, &said, sizeof said);
  return write(given, name, defaults, knownSize);
}

}  // namespace internal
}  // namespace foretouch::c
