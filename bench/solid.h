// bench/solid.h: `foretouch-bench solid`: how a solid avatar feels, what it costs, and whether it
// keeps its promises, beside the usual ways; and the goals that it is held to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/report.h"
#include "bench/solid/trial_tables.h"

namespace foretouch::tools {

/// Clips in scenes, and the trials of bench/solid/trial_tables.h.
inline constexpr const char* kSolidParts[] = {"scenes", "board", "clutter", "slide", "press"};

struct SolidBenchRequest {
  std::string dataFolder;  ///< With mocap/ and scenes/; empty: the bundled room and dancer alone.
  std::vector<std::string> scenes, clips;  ///< By name; empty: kitchen, office and room; six clips.
  std::vector<double> ratesHz{90.0};
  int places = 2;                  ///< Per clip and scene.
  double seconds = 4.0;            ///< At each.
  std::vector<std::string> parts;  ///< Of kSolidParts; empty: all.
  TrialRequest trials;             ///< Its options and seed are also those of the scenes.
  std::string command;
};

struct SolidBench {
  BenchReport report;
  std::uint64_t violations = 0;  ///< Of the promise, as the judge finds them.
};

/// One thread.
[[nodiscard]] Result<SolidBench> measureSolid(const SolidBenchRequest& request);

}  // namespace foretouch::tools
