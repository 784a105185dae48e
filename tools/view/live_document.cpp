#include "tools/view/live_document.h"

#include <cstddef>

#include <Eigen/Geometry>

#include "tools/report/document_parts.h"
#include "tools/report/view_writer.h"

namespace foretouch::tools {
namespace {

void addSettings(ServeConfig config, ViewDocument& document) {
  Settings settings;
  addServeSettings(settings, config);
  const auto add = [&](const std::vector<ViewRow>& rows) {
    document.settings.insert(document.settings.end(), rows.begin(), rows.end());
  };
  add(sceneSettings(config.world));
  add(querySettings(config.world));
  if (const std::size_t policies = config.world.policies.size(); policies > 0) {
    add({{"policies", std::to_string(policies), "of some links"}});
  }
  add(rowsOf(settings, {"workers", "address", "suffix"}));
}

ViewAvatar viewOf(const NumberedAvatar& served, const StreamSolver& solver,
                  std::vector<std::string>& notes) {
  ViewAvatar avatar;
  avatar.id = solver.id();
  avatar.name = fileName(served.path);
  avatar.avatar = &solver.avatar();
  avatar.isLiveSolid = solver.solid() != nullptr;
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
  document.title = "A stream in " + fileName(config.world.scenePath);
  addSettings(config, document);
  for (std::size_t i = 0; i < world.avatars.size(); ++i) {
    document.avatars.push_back(viewOf(config.avatars[i], world.avatars[i], document.notes));
  }
  if (config.person.isAsked()) {
    document.person.emplace();
    document.person->bounds = fileName(config.person.boundsPath);
    document.person->between = toString(config.person.model);
  }
  // The avatars' paths are unknown: all of the scene.
  addScene(world.scene, config.world.scenePath, kDefaultViewTriangles, Eigen::AlignedBox3d(),
           document);
  std::string text;
  writeView(document, [&](const std::string& piece) { text += piece; });
  return text;
}

}  // namespace foretouch::tools
