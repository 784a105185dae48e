#include "middleware/scene/huge_pages.h"

#include <algorithm>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace foretouch::internal {
namespace {

/// Of x86-64 and of most ARM machines; elsewhere the request just does not fit.
constexpr std::size_t kHugePage = std::size_t{2} << 20;

std::align_val_t alignmentOf(std::size_t bytes, std::size_t alignment) {
  return std::align_val_t{bytes < kHugePage ? alignment : std::max(alignment, kHugePage)};
}

}  // namespace

void* allocateInHugePages(std::size_t bytes, std::size_t alignment) {
  void* const memory = ::operator new(bytes, alignmentOf(bytes, alignment));
#ifdef MADV_HUGEPAGE
  // Whole pages only: what is left over would cost most of one. The answer may be no.
  const std::size_t whole = bytes / kHugePage * kHugePage;
  if (whole > 0) static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));
#endif
  return memory;
}

void freeHugePages(void* memory, std::size_t bytes, std::size_t alignment) {
  ::operator delete(memory, alignmentOf(bytes, alignment));
}

}  // namespace foretouch::internal
