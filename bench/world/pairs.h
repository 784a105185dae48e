// bench/world/pairs.h: two bodies that both move, by a world and by others' ways.
#pragma once

#include <cstdint>

#include "bench/peers/moving_pairs.h"
#include "bench/report.h"

namespace foretouch::tools {

struct PairsTable {
  BenchTable table;
  std::uint64_t violations = 0;  ///< Contacts that a world missed or told too late.
};
/// Beside FCL and Bullet where they are built in.
[[nodiscard]] PairsTable pairsTable(PairKind kind, int pairs, std::uint64_t seed);

}  // namespace foretouch::tools
