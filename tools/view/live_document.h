// tools/view/live_document.h: what a page shows of a service before anything has happened: its
// settings, its scene and its avatars.
#pragma once

#include <string>

#include "articulated/result.h"
#include "tools/stream/serve_config.h"
#include "tools/stream/served_world.h"

namespace foretouch::tools {

/// The page's HTML.
[[nodiscard]] std::string livePage();

/// Its document, of kind "live" (docs/formats.md, "View documents").
[[nodiscard]] Result<std::string> liveDocument(const ServeConfig& config, const ServedWorld& world);

}  // namespace foretouch::tools
