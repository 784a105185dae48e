// bench/memory.h: the time and memory of a scene and an avatar before the first answer, stage by
// stage.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {

/// A scene to load, and an avatar in it.
struct MemoryRequest : WorldRequest {
  std::string avatarPath;
};

/// A stage's duration, and this process's memory after it, as the system counts it (without the
/// import child).
struct MemoryStage {
  std::string name;
  double ms = 0.0;
  double peakMiB = 0.0;      ///< VmHWM: since the process began.
  double residentMiB = 0.0;  ///< VmRSS: including freed memory kept for later.
  double heapMiB = 0.0;      ///< Of it, allocated and not freed (glibc's count; else 0).
};

struct MemoryBench {
  std::vector<MemoryStage> stages;
  std::size_t sceneTriangles = 0;
  std::size_t surfaceTriangles = 0;  ///< Loaded for the links that need them.
  std::size_t exactLinks = 0;
  std::int32_t links = 0;
};

/// Loads the request's files, as a replay does, and queries the rest pose twice. Errors name the
/// file or option, or say that the system does not report a process's memory.
[[nodiscard]] Result<MemoryBench> measureMemory(const MemoryRequest& request);

/// One row per stage.
[[nodiscard]] std::string memoryTable(const MemoryBench& bench);

/// What the program has allocated and not freed (glibc's count; else 0).
[[nodiscard]] double heapMiB();

}  // namespace foretouch::tools
