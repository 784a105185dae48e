#include "tests/support/allocation_count.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define FORETOUCH_COUNTS_ALLOCATIONS 0
#else
#define FORETOUCH_COUNTS_ALLOCATIONS 1
#endif

namespace {
std::atomic<std::uint64_t> allocations{0};
std::atomic<std::int64_t> leftUntilFailure{-1};  // negative: none fails

/// Counts the call; true if it is the one that is to fail.
[[maybe_unused]] bool isOut() {
  ++allocations;
  return leftUntilFailure >= 0 && leftUntilFailure-- == 0;
}
}  // namespace

#if FORETOUCH_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  if (isOut()) return nullptr;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  if (isOut()) return nullptr;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  if (isOut()) return nullptr;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  if (isOut()) return nullptr;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  if (isOut()) return nullptr;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) {
  if (isOut()) return ENOMEM;
  *place = __libc_memalign(alignment, size);
  return *place == nullptr ? ENOMEM : 0;
}
}
#endif

namespace foretouch::test {

bool countsAllocations() {
  return FORETOUCH_COUNTS_ALLOCATIONS != 0;
}

std::uint64_t numAllocations() {
  return allocations;
}

void failAllocationAfter(std::int64_t more) {
  leftUntilFailure = more;
}

bool stopFailing() {
  return leftUntilFailure.exchange(-1) < 0;
}

}  // namespace foretouch::test
