// tests/world_fuzz/fuzz_in_c.h: a random world through the C library.
#pragma once

#include <string>

#include "tests/world_fuzz/fuzz_judge.h"
#include "tools/world/loaded_world.h"

namespace foretouch::test {

/// What C tells otherwise than `told`, or refuses; empty: nothing.
[[nodiscard]] std::string otherInC(const FuzzWorld& drawn, const tools::LoadedWorld& world,
                                   const FuzzTold& told);

}  // namespace foretouch::test
