// bench/cage.h: what the importer's cage costs an import, and how much memory small files take.
#pragma once

#include <string>

#include "articulated/result.h"
#include "bench/report.h"

namespace foretouch::tools {

struct CageRequest {
  int triangles = 100'000;
  int repeats = 15;
  std::string command;  ///< As typed in.
};

/// Imports a file of so many triangles with and without the cage, in turns, and a file of 3 kB
/// whose nodes place one another's instances. Errors name the file or the importer.
[[nodiscard]] Result<BenchReport> measureCage(const CageRequest& request);

}  // namespace foretouch::tools
