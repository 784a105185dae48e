// bench/world.h: `foretouch-bench world`: what a moving world costs, by itself and beside others'
// ways, and whether it keeps its promise where the truth is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

inline constexpr const char* kWorldParts[] = {"crowd", "self",  "clocks",  "platform", "prop",
                                              "exact", "pairs", "ticking", "events",   "following"};

struct WorldBenchRequest {
  std::string dataFolder;          ///< With mocap/; without clips in it, the bundled dancer.
  std::vector<std::string> clips;  ///< By name or path; empty: six.
  std::vector<std::string> parts;  ///< Of kWorldParts; empty: all.
  std::vector<int> avatars{2, 10, 30, 100, 300, 1000, 3000};
  int pairs = 2000;          ///< Of two capsules.
  int tickingWindows = 100;  ///< Of two people.
  std::uint64_t seed = 1;
  std::string command;
};

struct WorldBench {
  BenchReport report;
  std::uint64_t violations = 0;  ///< Of the promise, as the judge finds them.
};

/// One thread. Errors name a file, or the part of the input.
[[nodiscard]] Result<WorldBench> measureWorld(const WorldBenchRequest& request);

}  // namespace foretouch::tools
