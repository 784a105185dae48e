// bench/world/pairs.h: two LSS that both move, by a world and by others' ways.
#pragma once

#include <cstdint>

#include "bench/report.h"

namespace foretouch::tools {

struct PairsTable {
  BenchTable table;
  std::uint64_t violations = 0;  ///< Contacts that a world missed or told too late.
};
/// Beside FCL and Bullet where they are built in.
[[nodiscard]] PairsTable pairsTable(int pairs, std::uint64_t seed);

}  // namespace foretouch::tools
