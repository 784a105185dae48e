// bench/solid/cast.h: which clips play in which scenes, by name: those that are there.
#pragma once

#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/solid/stage.h"

namespace foretouch::tools {

/// It has no scenes for a world, which brings its own.
struct Cast {
  std::vector<SolidActor> actors;
  std::vector<SolidStage> stages;
  std::vector<std::string> leftOut;  ///< Names of those that are not there, or have no two frames.
};

/// `dataFolder`: with mocap/ and scenes/. `scenes`: kitchen, office, collision-world, undulating,
/// room; kitchen, office and room if there are none. `clips`: of mocap/, or paths; "all"; six if
/// there are none. Without any clip, the bundled dancer.
[[nodiscard]] Result<Cast> loadCast(const std::string& dataFolder, std::vector<std::string> scenes,
                                    const std::vector<std::string>& clips);

/// Loads only the same clips.
[[nodiscard]] Result<Cast> loadActors(const std::string& dataFolder,
                                      const std::vector<std::string>& clips);

/// The names, separated by commas.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace foretouch::tools
