// bench/leaf.h: `foretouch-bench leaf` in words and in JSON. Machine-independent results come
// first: counts, wrong answers, the stages that decided; then times.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/leaf_timing.h"

namespace foretouch::tools {

struct LeafBench {
  std::vector<TimedSet> sets;
  int repeat = 1;
  double overheadUs = 0.0;  ///< Already subtracted from every time.
  std::uint64_t seed = 0;   ///< The seed of generated queries.
  std::size_t generated = 0;
};

/// Every set separately, then the sets named erleben-* together ("handcrafted"), then all labelled
/// ones.
[[nodiscard]] std::vector<LeafGroup> leafGroups(const LeafBench& bench);
[[nodiscard]] std::string leafTable(const LeafBench& bench);
/// One object: "repeat", "clock_overhead_us", "seed", "generated", "groups".
[[nodiscard]] std::string leafJson(const LeafBench& bench);
/// Wrong answers over all labelled sets.
[[nodiscard]] std::size_t wrongAnswers(const LeafBench& bench);

}  // namespace foretouch::tools
