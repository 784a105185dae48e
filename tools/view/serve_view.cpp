#include "tools/view/serve_view.h"

#include <memory>
#include <utility>

#include "articulated/try.h"
#include "tools/console.h"
#include "tools/report/viewer_page.h"
#include "tools/view/live_document.h"

namespace foretouch::tools {

std::optional<ServeView> prepareView(const ServeConfig& config, const ServedWorld& world) {
  if (config.view.empty()) return std::nullopt;
  ServeView view;
  view.page = viewerPage();
  view.document = liveDocument(config, world);
  for (const StreamSolver& avatar : world.avatars) view.world.avatarIds.push_back(avatar.id());
  view.world.objectNames = world.scene.objectNames();
  view.world.objectOf = [scene = world.scene](TriangleId triangle) {
    return static_cast<std::size_t>(scene.object(triangle));
  };
  return view;
}

Result<std::optional<ViewServer>> openView(const ServeConfig& config, std::optional<ServeView> view,
                                           const Service& service, ViewFeed& feed) {
  if (!view) return std::optional<ViewServer>();
  FORETOUCH_TRY(const auto address, parseViewAddress("--view", config.view));
  view->world.startUtimeUs = service.facts().startUtimeUs;
  ViewServer::Pages pages;
  pages.page = std::move(view->page);
  pages.document = std::move(view->document);
  pages.events = std::make_unique<LiveEvents>(feed, std::move(view->world),
                                              [&service] { return service.status(); });
  FORETOUCH_TRY(auto server,
                inFile(ViewServer::start(address.host, address.port, std::move(pages)), "--view"));
  return std::optional<ViewServer>(std::move(server));
}

}  // namespace foretouch::tools
