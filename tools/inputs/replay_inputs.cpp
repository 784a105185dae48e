#include "tools/inputs/replay_inputs.h"

#include <utility>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <fmt/format.h>

#include "assets/import/scene_import.h"
#include "assets/mesh/link_mesh.h"
#include "middleware/query/work_budget.h"
#include "tools/console.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/ignored_pairs.h"
#include "tools/inputs/played_clip.h"
#include "tools/inputs/policy_rules.h"
#include "tools/inputs/skin_file.h"

namespace foretouch::tools {
namespace {

/// The allocator keeps memory that building freed: a third of the total after a large scene.
void giveBackFreeMemory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

/// The meshes of the avatar file, if the fidelity needs them.
Result<Done> loadSurface(const WorldRequest& request, const std::string& avatarPath,
                         const Avatar& avatar, QueryOptions& query) {
  if (query.fidelity == Fidelity::Skinned) {
    auto skin = loadSkin(request.skinPath, request.skinImport, avatar);
    if (!skin.ok()) return skin.error();
    query.skin = std::move(skin).value();
    return Done{};
  }
  if (query.fidelity != Fidelity::Exact) return Done{};
  std::vector<LinkId> exact;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (query.linkPolicies.empty() ||
        query.linkPolicies[static_cast<std::size_t>(link)].fidelity == Fidelity::Exact) {
      exact.push_back(link);
    }
  }
  auto meshes = loadLinkMeshes(avatar, avatarPath, exact);
  if (!meshes.ok()) return inFile(meshes.error(), avatarPath);
  auto surface = AvatarSurface::build(avatar, std::move(meshes).value());
  if (!surface.ok()) return inFile(surface.error(), avatarPath);
  // So that the first steps' latencies are the query's alone, unless policies make few links exact.
  if (query.linkPolicies.empty()) surface.value().prepare();
  query.surface = std::move(surface).value();
  return Done{};
}

}  // namespace

Result<Scene> loadScene(const WorldRequest& request) {
  auto imported = importScene(request.scenePath, request.sceneImport);
  if (!imported.ok()) return inFile(imported.error(), request.scenePath);
  auto scene = Scene::build(std::move(imported.value().scene));
  if (!scene.ok()) return inFile(scene.error(), request.scenePath);
  giveBackFreeMemory();
  return scene;
}

Result<QueryOptions> queryOptionsFor(const WorldRequest& request, const std::string& avatarPath,
                                     const Avatar& avatar, const Scene& scene) {
  QueryOptions query = request.query;
  if (request.budgetUs > 0) query.workBudget = workBudget(static_cast<double>(request.budgetUs));
  auto ignored = parseIgnoredPairs(request.ignore, avatar.skeleton(), scene.objectNames());
  if (!ignored.ok()) return ignored.error();
  query.ignored = std::move(ignored).value();
  const auto applied =
      applyPolicies(request.policies, avatar.skeleton(), scene.objectNames(), query);
  if (!applied.ok()) return applied.error();
  const auto surface = loadSurface(request, avatarPath, avatar, query);
  if (!surface.ok()) return surface.error();
  return query;
}

Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request) {
  auto played = loadPlayedClip(request);
  if (!played.ok()) return played.error();
  auto& [avatar, clip, match, steps, isUpright] = played.value();
  auto scene = loadScene(request);
  if (!scene.ok()) return scene.error();
  auto query = queryOptionsFor(request, request.avatarPath, avatar, scene.value());
  if (!query.ok()) return query.error();
  return ReplayInputs{
      request, std::move(scene).value(), std::move(avatar), std::move(clip), std::move(match),
      steps,   std::move(query).value(), isUpright};
}

std::vector<std::string> remarksOn(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::vector<std::string> remarks = remarksOnClip(inputs.avatar, inputs.clip, inputs.match,
                                                   request.avatarPath, request.motionPath);
  if (const std::size_t dropped = inputs.scene.audit().droppedNonFinite; dropped > 0) {
    remarks.push_back(fmt::format("{}: {} triangles with a vertex that is not finite were left out",
                                  request.scenePath, dropped));
  }
  return remarks;
}

Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame) {
  return poseAtFrame({inputs.avatar, inputs.clip, inputs.match, inputs.request.placement,
                      inputs.isUpright, inputs.request.motionPath},
                     frame);
}

}  // namespace foretouch::tools
