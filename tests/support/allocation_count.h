// tests/support/allocation_count.h: counts this program's calls of malloc and its kin, and
// simulates lack of memory. Its source is compiled into each program that needs it, and replaces
// that program's allocator.
#pragma once

#include <cstdint>

namespace foretouch::test {

/// False if the build has its own allocator (sanitizers): then it counts nothing.
[[nodiscard]] bool countsAllocations();
/// Of all threads, since the start.
[[nodiscard]] std::uint64_t numAllocations();

/// Makes one allocation of the program fail: the one after `more` others.
void failAllocationAfter(std::int64_t more);
/// From now on none fails. True if one has failed since failAllocationAfter().
bool stopFailing();

}  // namespace foretouch::test
