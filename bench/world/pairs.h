// bench/world/pairs.h: two bodies that both move, by a world and by others' ways.
#pragma once

#include <cstdint>

#include "bench/peers/moving_pairs.h"
#include "bench/report.h"

namespace foretouch::tools {

/// A violation is a contact that a world missed or reported too late.
/// Beside FCL and Bullet where they are built in.
[[nodiscard]] JudgedTable pairsTable(PairKind kind, int pairs, std::uint64_t seed);

}  // namespace foretouch::tools
