#include "tools/world/load_world.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/near_names.h"
#include "lss/index.h"
#include "tools/inputs/own_pairs.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/world/body_knots.h"
#include "tools/world/file_triggers.h"
#include "tools/world/world_maker.h"

namespace foretouch::tools {
namespace {

/// The number of a group, which the world has not more than 32 of.
Result<BodyGroup> groupOf(const std::string& name, std::int64_t line, LoadedWorld& loaded) {
  std::vector<std::string>& groups = loaded.groups;
  const auto known = std::find(groups.begin(), groups.end(), name);
  const auto group = static_cast<BodyGroup>(known - groups.begin());
  if (known != groups.end()) return group;
  const auto most =
      static_cast<BodyGroup>(loaded.file.hasTriggers() ? kTriggerGroup : kNumBodyGroups);
  if (group == most) {
    return Error::inLine(
        loaded.file.path, line, ErrorCode::LimitExceeded,
        fmt::format("[[body]] group: expected at most {} groups{}, found {} as one more", most,
                    loaded.file.hasTriggers() ? " beside triggers" : "", inQuotes(name)));
  }
  groups.push_back(name);
  return group;
}

Result<Done> applyAsks(LoadedWorld& loaded) {
  const auto groupNamed = [&](const std::string& name, const FileAsk& ask) -> Result<BodyGroup> {
    const std::vector<std::string>& groups = loaded.groups;
    const auto known = std::find(groups.begin(), groups.end(), name);
    if (known != groups.end()) return static_cast<BodyGroup>(known - groups.begin());
    return Error::inLine(loaded.file.path, ask.line, ErrorCode::UnknownName,
                         "[[ask]]: expected the group of a body, or scene, found " +
                             inQuotes(name) + didYouMean(name, groups));
  };
  for (const FileAsk& ask : loaded.file.asks) {
    FORETOUCH_TRY(const BodyGroup group, groupNamed(ask.group, ask));
    if (ask.with.empty()) {
      FORETOUCH_CHECK(loaded.world.askStill(group, ask.isAsked));
      continue;
    }
    FORETOUCH_TRY(const BodyGroup with, groupNamed(ask.with, ask));
    FORETOUCH_CHECK(loaded.world.ask(group, with, ask.isAsked));
  }
  return Done{};
}

/// The world without bodies.
Result<LoadedWorld> emptyWorld(WorldFile file) {
  std::optional<Scene> scene;
  FileFrame frame;
  if (!file.scene.scenePath.empty()) {
    FORETOUCH_TRY(scene, loadScene(file.scene, frame));
    file.scene.sceneImport.scale = frame.metresPerUnit;
    file.scene.sceneImport.up = frame.up;
  }
  WorldOptions options;
  options.tolerance = file.tolerance;
  options.askMeshes = file.askMeshes;
  FORETOUCH_TRY(auto world, World::build(scene, options));
  return LoadedWorld{std::move(file),
                     std::move(scene),
                     frame,
                     {},
                     {},
                     std::move(world),
                     0,
                     0,
                     std::nullopt,
                     {},
                     {}};
}

/// Reads what the body is and how it moves, and adds it to the world.
Result<BodyKnots> addBody(const FileBody& body, ShapeLoader& shapes, KnotLoader& knots,
                          LoadedWorld& loaded) {
  const std::string& path = loaded.file.path;
  FORETOUCH_TRY(auto shape, shapes.load(body, path));
  FORETOUCH_TRY(auto told, knots.load(body, shape, path));
  if (body.trigger) {
    FORETOUCH_CHECK(addTrigger(body, shape, path, loaded.world, loaded.triggers));
    loaded.remarks.insert(loaded.remarks.end(), told.remarks.begin(), told.remarks.end());
    loaded.bodies.push_back({std::move(shape), {}, {}, kTriggerGroup});
    return told;
  }
  FORETOUCH_TRY(const auto group, groupOf(body.group, body.line, loaded));
  BodyOptions options;
  options.group = group;
  options.whenSilent = body.whenSilent;
  options.self = told.self;
  options.surface = shape.surface;
  const auto added = shape.avatar ? loaded.world.add(*shape.avatar, options)
                                  : loaded.world.add(*shape.mesh, options);
  if (!added.ok()) {
    return Error::inLine(
        path, body.line, added.error().code,
        fmt::format("{} {}: {}", body.title(), inQuotes(body.name), added.error().message));
  }
  const std::vector<std::string>& remarks = told.remarks;
  loaded.remarks.insert(loaded.remarks.end(), remarks.begin(), remarks.end());
  if (told.self && !told.self->leftOut().empty()) {
    loaded.remarks.push_back(
        fmt::format("{}: {} of {} pairs of own links are left out, so nothing is said of them ({})",
                    inQuotes(body.name), told.self->leftOut().size(), told.self->numPairs(),
                    reasonsOf(*told.self)));
  }
  loaded.bodies.push_back({std::move(shape), {}, {}, group});
  loaded.bodies.back().lostLinks = std::move(told.lostLinks);
  loaded.bodies.back().leftOut = std::move(told.leftOut);
  return told;
}

}  // namespace

Result<LoadedWorld> loadWorld(WorldFile file) {
  FORETOUCH_TRY(auto loaded, emptyWorld(std::move(file)));
  ShapeLoader shapes;
  KnotLoader loader;
  std::vector<BodyKnots> knots;
  for (const FileBody& body : loaded.file.bodies) {
    FORETOUCH_TRY(auto told, addBody(body, shapes, loader, loaded));
    knots.push_back(std::move(told));
  }
  FORETOUCH_CHECK(applyAsks(loaded));
  std::vector<const Skeleton*> skeletons;
  for (const LoadedBody& body : loaded.bodies) skeletons.push_back(&body.shape.skeleton);
  FORETOUCH_CHECK(watchAll(loaded.file, skeletons, loaded.world, loaded.triggers));
  FORETOUCH_CHECK(tellWorld(loaded, std::move(knots)));
  return loaded;
}

}  // namespace foretouch::tools
