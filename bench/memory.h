// bench/memory.h: what a scene and an avatar cost before the first answer: time and memory,
// stage by stage.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// What is loaded: a scene, and an avatar in it.
struct MemoryRequest : WorldRequest {
  std::string avatarPath;
};

/// After a stage: what it took, and this process's memory as the system counts it (the import child
/// not included).
struct MemoryStage {
  std::string name;
  double ms = 0.0;
  double peakMiB = 0.0;      ///< VmHWM: since the process began.
  double residentMiB = 0.0;  ///< VmRSS: with what is free again but kept for later.
  double heapMiB = 0.0;      ///< Of it, asked for and not given back (glibc's count; else 0).
};

struct MemoryBench {
  std::vector<MemoryStage> stages;
  std::size_t sceneTriangles = 0;
  std::size_t surfaceTriangles = 0;  ///< Loaded for the links that need them.
  std::size_t exactLinks = 0;
  std::int32_t links = 0;
};

/// Loads what the request names, as a replay does, and asks about the rest pose twice. Errors name
/// the file or option; where the system does not tell a process its memory, the error is about
/// that.
[[nodiscard]] Result<MemoryBench> measureMemory(const MemoryRequest& request);

/// One row a stage.
[[nodiscard]] std::string memoryTable(const MemoryBench& bench);

}  // namespace foretouch::tools
