// tools/view/serve_view.h: `foretouch serve --view`: shows a service in a browser.
#pragma once

#include <optional>
#include <string>

#include "articulated/result.h"
#include "network/service/service.h"
#include "network/watch/view_feed.h"
#include "network/watch/view_server.h"
#include "tools/stream/serve_config.h"
#include "tools/stream/served_world.h"
#include "tools/view/live_events.h"

namespace foretouch::tools {

/// The page's data, collected before a service takes the world's avatars.
struct ServeView {
  std::string page, document;
  LiveWorld world;
};

/// None if not requested.
[[nodiscard]] std::optional<ServeView> prepareView(const ServeConfig& config,
                                                   const ServedWorld& world);

/// `feed` is the service's observer; both outlive the server. Errors name the option.
[[nodiscard]] Result<std::optional<ViewServer>> openView(const ServeConfig& config,
                                                         std::optional<ServeView> view,
                                                         const Service& service, ViewFeed& feed);

}  // namespace foretouch::tools
