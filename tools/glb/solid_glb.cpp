#include "tools/glb/solid_glb.h"

#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "tools/glb/replay_scene.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

/// Markers are costly to viewers, each an animated node.
constexpr std::size_t kMostPushes = 5000;

/// The touches with the scene: own links have no place in it.
std::vector<ShownTouch> pushesOf(const ShownTrack& track, std::vector<std::string>& notes) {
  std::vector<ShownTouch> shown;
  std::size_t leftOut = 0;
  for (const ShownTouchOf& touch : track.touches()) {
    if (touch.touch.other >= 0) continue;
    if (shown.size() == kMostPushes) {
      ++leftOut;
      continue;
    }
    shown.push_back({track.contacts()[touch.first], touch.touch, touch.touch.endS, touch.mostPush});
  }
  if (leftOut > 0) {
    notes.push_back(
        fmt::format("{} touches are not shown: the first {} are", leftOut, kMostPushes));
  }
  return shown;
}

json extrasOf(const std::string& header) {
  json extras = json::parse(header);
  extras.erase("mark");
  return extras;
}

}  // namespace

Result<std::vector<std::string>> writeSolidGlb(const ReplayInputs& inputs, const ShownTrack& track,
                                               const std::string& header,
                                               const GlbRequest& request) {
  FORETOUCH_TRY(const auto stage,
                inFile(stageOf(inputs, track.poses(), track.timesS()), request.path));
  std::vector<std::string> notes;
  const std::vector<ShownTouch> shown = pushesOf(track, notes);
  GlbContent content(fmt::format("foretouch {}", FORETOUCH_VERSION));
  GltfDocument& document = content.document();
  GlbAnimation animation("replay");
  TriangleBudget budget(request.mostTriangles);
  const std::size_t world = addWorld(stage.origin, extrasOf(header), document);
  const auto meshes = addLinkMeshes(stage, content, budget, notes);
  addAvatar({inputs.avatar.skeleton(), stage.poses, stage.timesS}, meshes,
            addGroup(document, world, "avatar"), stage.origin, content, animation);
  const auto ghosts = addGhostMeshes(stage, content, budget, notes);
  addAvatar({inputs.avatar.skeleton(), track.tracked(), track.tickTimesS()}, ghosts,
            addGroup(document, world, "tracked"), stage.origin, content, animation);
  const std::vector<Appearance> appearances =
      addMarkers(stage, shown, addGroup(document, world, "contacts"), content);
  addAppearances(appearances, stage.timesS.back(), content, animation);
  addScene(stage, shown, addGroup(document, world, "scene"), content, budget, notes);
  animation.finish(document);

  FORETOUCH_CHECK(content.writeFile(request.path));
  return notes;
}

}  // namespace foretouch::tools
