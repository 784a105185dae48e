// middleware/scene/huge_pages.h: memory for arrays that every step reads here and there: large ones
// ask the system for huge pages, which spare the processor most of the work of finding where a page
// lies. What the system refuses costs nothing but that. Not installed.
#pragma once

#include <cstddef>
#include <vector>

namespace foretouch::internal {

/// Aligned to `alignment`, or to a huge page if there is room for one. Throws std::bad_alloc.
[[nodiscard]] void* allocateInHugePages(std::size_t bytes, std::size_t alignment);
/// What allocateInHugePages() gave for the same numbers.
void freeHugePages(void* memory, std::size_t bytes, std::size_t alignment);

template <typename T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <typename U>
  explicit HugePageAllocator(const HugePageAllocator<U>& /*other*/) {}

  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(allocateInHugePages(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t count) {
    freeHugePages(memory, count * sizeof(T), alignof(T));
  }
  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
  friend bool operator!=(const HugePageAllocator&, const HugePageAllocator&) { return false; }
};

template <typename T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace foretouch::internal
