// tools/view/live_document.h: what a page shows of a service before anything has happened: its
// settings, its scene and its avatars.
#pragma once

#include <string>

#include "tools/stream/serve_config.h"
#include "tools/stream/served_world.h"

namespace foretouch::tools {

/// A view document of kind "live" (docs/formats.md, "View documents"). Scenes beyond
/// kDefaultViewTriangles are simplified, which takes its time.
[[nodiscard]] std::string liveDocument(const ServeConfig& config, const ServedWorld& world);

}  // namespace foretouch::tools
