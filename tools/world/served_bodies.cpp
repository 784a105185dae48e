#include "tools/world/served_bodies.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"

namespace foretouch::tools {
namespace {

/// What is asked about groups, by their numbers; nothing in `with`: about the scene.
struct GroupAsk {
  BodyGroup group = 0;
  std::optional<BodyGroup> with;
  bool isAsked = false;
};

std::vector<GroupAsk> asksOf(const LoadedWorld& world) {
  const auto numberOf = [&](const std::string& name) {
    const auto place = std::find(world.groups.begin(), world.groups.end(), name);
    return static_cast<BodyGroup>(place - world.groups.begin());
  };
  std::vector<GroupAsk> asks;
  for (const FileAsk& ask : world.file.asks) {
    GroupAsk& told = asks.emplace_back();
    told.group = numberOf(ask.group);
    if (!ask.with.empty()) told.with = numberOf(ask.with);
    told.isAsked = ask.isAsked;
  }
  return asks;
}

Result<Done> askAll(World& world, const std::vector<GroupAsk>& asks) {
  for (const GroupAsk& ask : asks) {
    FORETOUCH_CHECK(ask.with ? world.ask(ask.group, *ask.with, ask.isAsked)
                             : world.askStill(ask.group, ask.isAsked));
  }
  return Done{};
}

}  // namespace

WorldSetup servedBodies(const LoadedWorld& world) {
  WorldSetup setup;
  setup.still = world.scene;
  setup.options.tolerance = world.file.tolerance;
  // Senders that we do not know may put a thousand bodies into one place.
  setup.options.workPerWindow = kServedWorkPerWindow;
  setup.options.mostNear = kServedMostNear;
  setup.ask = [asks = asksOf(world)](World& asked) { return askAll(asked, asks); };
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const LoadedBody& body = world.bodies[i];
    setup.shapes.push_back(
        {world.file.bodies[i].name, body.shape.avatar, body.shape.mesh, body.group, body.self});
    if (!world.file.bodies[i].shape.avatarPath.empty()) {
      setup.avatars.push_back({numberInMessages(i), i});
    }
  }
  return setup;
}

std::vector<std::string> remarksOnServing(const LoadedWorld& world) {
  std::vector<std::string> remarks;
  std::string moved;
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const FileBody& body = world.file.bodies[i];
    const bool isPlaced = world.bodies[i].numPoses > 0 || body.place || !body.changes.empty();
    if (isPlaced) moved += (moved.empty() ? "" : ", ") + inQuotes(body.name);
  }
  if (!moved.empty()) {
    remarks.push_back(
        fmt::format("{}: where it says that bodies are does not count, their streams do: {}",
                    world.file.path, moved));
  }
  for (std::size_t i = world.numBodies(); i < world.bodies.size(); ++i) {
    remarks.push_back(fmt::format("{}:{}: a service tells of no triggers: {} does not count",
                                  world.file.path, world.file.bodies[i].line,
                                  inQuotes(world.file.bodies[i].name)));
  }
  return remarks;
}

}  // namespace foretouch::tools
