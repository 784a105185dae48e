#include "assets/import/memory_budget.h"

#include <algorithm>
#include <sys/resource.h>

#include "lss/sanitizer.h"

namespace foretouch::internal {

void grantMemoryFor(std::uint64_t bytes) {
  // No file system holds more; this keeps the product below 2^64.
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 50;
  static std::uint64_t read = 0;
  read = std::min(read + std::min(bytes, kMostBytes), kMostBytes);
  rlimit current{};
  if (kUnderSanitizer || getrlimit(RLIMIT_AS, &current) != 0) return;
  current.rlim_cur = std::min<rlim_t>(kMemoryForNothing + kMemoryPerByte * read, current.rlim_max);
  setrlimit(RLIMIT_AS, &current);
}

std::uint64_t grantedMemory() {
  rlimit current{};
  return getrlimit(RLIMIT_AS, &current) == 0 ? current.rlim_cur : 0;
}

}  // namespace foretouch::internal
