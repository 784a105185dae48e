#include "tools/view/live_document.h"

#include <cstddef>

#include <Eigen/Geometry>

#include "tools/report/document_parts.h"
#include "tools/report/view_writer.h"

namespace foretouch::tools {
namespace {

void addSettings(const ServeConfig& config, ViewDocument& document) {
  const ReplayRequest request = asReplay(config, std::string());
  const auto add = [&](const std::vector<ViewRow>& rows) {
    document.settings.insert(document.settings.end(), rows.begin(), rows.end());
  };
  add(sceneSettings(request));
  add(querySettings(request));
  if (!config.policies.empty()) {
    add({{"policies", std::to_string(config.policies.size()), "of some links"}});
  }
  add({{"workers", std::to_string(config.workers), ""}, {"address", config.url, ""}});
  if (!config.suffix.empty()) add({{"suffix", config.suffix, ""}});
}

ViewAvatar viewOf(const ServedAvatar& served, const StreamSolver& solver,
                  std::vector<std::string>& notes) {
  ViewAvatar avatar;
  avatar.id = solver.id();
  avatar.name = fileName(served.file);
  avatar.avatar = &solver.avatar();
  const QueryOptions& query = solver.options();
  if (query.fidelity == Fidelity::Exact && query.surface) {
    avatar.meshes = linkMeshes(trianglesOf(*query.surface), notes);
  }
  return avatar;
}

}  // namespace

std::string liveDocument(const ServeConfig& config, const ServedWorld& world) {
  ViewDocument document;
  document.kind = ViewKind::Live;
  document.title = "A stream in " + fileName(config.scene);
  addSettings(config, document);
  for (std::size_t i = 0; i < world.avatars.size(); ++i) {
    document.avatars.push_back(viewOf(config.avatars[i], world.avatars[i], document.notes));
  }
  // Where avatars will go is not known: all of the scene.
  addScene(world.scene, config.scene, kDefaultViewTriangles, Eigen::AlignedBox3d(), document);
  std::string text;
  writeView(document, [&](const std::string& piece) { text += piece; });
  return text;
}

}  // namespace foretouch::tools
