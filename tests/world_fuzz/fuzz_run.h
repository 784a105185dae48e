// tests/world_fuzz/fuzz_run.h: one seed: a random world is written as a file, read, followed and
// asked, in two orders of its tables and through the C library, and judged.
#pragma once

#include <cstdint>
#include <functional>

#include "tests/world_fuzz/fuzz_judge.h"

namespace foretouch::test {

/// `lie`: changes what was told before it is judged.
[[nodiscard]] FuzzTally runFuzzWorld(std::uint64_t seed,
                                     const std::function<void(FuzzTold&)>& lie = {});

}  // namespace foretouch::test
