// tests/support/allocation_count.h: how often this program has called malloc or its kin. Its source
// is compiled into each program that asks, whose allocator it then is.
#pragma once

#include <cstdint>

namespace foretouch::test {

/// False where the build has an allocator of its own (sanitizers): nothing is counted then.
[[nodiscard]] bool countsAllocations();
/// Of all threads, since the start.
[[nodiscard]] std::uint64_t numAllocations();

}  // namespace foretouch::test
