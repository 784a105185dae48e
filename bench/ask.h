// bench/ask.h: `foretouch-bench ask`: what questions to a world at an instant cost, beside Embree's
// rays, and what a server's other ways to look at the past miss and invent.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

inline constexpr const char* kAskParts[] = {"crowd", "players", "scene", "shots"};

struct AskBenchRequest {
  std::string dataFolder;          ///< With mocap/; without clips in it, the bundled dancer.
  std::vector<std::string> clips;  ///< By name or path; empty: six.
  std::vector<std::string> parts;  ///< Of kAskParts; empty: all.
  std::vector<int> avatars{1, 10, 100, 1000};
  int questions = 5000;     ///< Of each kind.
  int shots = 2000;         ///< Per row.
  int triangles = 300'000;  ///< Of the scene of rays.
  std::uint64_t seed = 1;
  std::string command;
};

struct AskBench {
  BenchReport report;
  std::uint64_t violations = 0;  ///< Answers that are not the judge's.
};

/// One thread. Errors name a file, or the part of the input.
[[nodiscard]] Result<AskBench> measureAsk(const AskBenchRequest& request);

}  // namespace foretouch::tools
