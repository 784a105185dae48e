// tools/view/live_document.h: the page of a service before the first event: its settings, its scene
// and its avatars.
#pragma once

#include <string>

#include "tools/stream/serve_config.h"
#include "tools/stream/served_world.h"

namespace foretouch::tools {

/// A view document of kind "live" (docs/formats.md, "View documents"). Simplifies scenes beyond
/// kDefaultViewTriangles, which takes time.
[[nodiscard]] std::string liveDocument(const ServeConfig& config, const ServedWorld& world);

}  // namespace foretouch::tools
