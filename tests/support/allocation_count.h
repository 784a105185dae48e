// tests/support/allocation_count.h: how often this program has called malloc or its kin, and
// what it does where there is no memory. Its source is compiled into each program that asks, whose
// allocator it then is.
#pragma once

#include <cstdint>

namespace foretouch::test {

/// False where the build has an allocator of its own (sanitizers): nothing is counted then.
[[nodiscard]] bool countsAllocations();
/// Of all threads, since the start.
[[nodiscard]] std::uint64_t numAllocations();

/// One allocation of the program finds no memory: the one after so many more.
void failAllocationAfter(std::int64_t more);
/// None does, from now on. True if one has been failed since it was asked for.
bool stopFailing();

}  // namespace foretouch::test
