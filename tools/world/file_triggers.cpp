#include "tools/world/file_triggers.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/near_names.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

Result<TriggerVolume> volumeOf(const BodyShape& shape) {
  if (!shape.avatar) return TriggerVolume::mesh(*shape.mesh);
  return TriggerVolume::lss(shape.avatar->lss(0));
}

Result<Watched> watchedOf(const WorldFile& file, const std::vector<const Skeleton*>& skeletons,
                          const FileBody& trigger, const FileWatch& watch) {
  std::vector<std::string> names;
  for (const FileBody& body : file.bodies) {
    if (!body.trigger) names.push_back(body.name);
  }
  const auto found = std::find(names.begin(), names.end(), watch.body);
  if (found == names.end()) {
    return Error::inLine(file.path, watch.line, ErrorCode::UnknownName,
                         trigger.title("watches") + " body: expected the name of a body, found " +
                             inQuotes(watch.body) + didYouMean(watch.body, names));
  }
  Watched watched;
  watched.body = static_cast<BodyId>(found - names.begin());
  if (watch.link.empty()) return watched;
  const Skeleton& skeleton = *skeletons[slotOf(watched.body)];
  if (const auto link = skeleton.find(watch.link)) {
    watched.link = *link;
    return watched;
  }
  std::vector<std::string> links;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) links.push_back(skeleton.name(link));
  return Error::inLine(
      file.path, watch.line, ErrorCode::UnknownName,
      fmt::format("{} link: expected a link of {}, found {}{}", trigger.title("watches"),
                  inQuotes(watch.body), inQuotes(watch.link), didYouMean(watch.link, links)));
}

}  // namespace

Result<Done> addTrigger(const FileBody& file, const BodyShape& shape, const std::string& path,
                        World& world, Triggers& triggers) {
  const auto inWorld = [&](Error error) {
    return Error::inLine(path, file.line, error.code,
                         file.title() + " " + inQuotes(file.name) + ": " + error.message);
  };
  FORETOUCH_TRY_OR(inWorld, const auto volume, volumeOf(shape));
  TriggerOptions options;
  options.whenSilent = file.whenSilent;
  options.byLink = file.trigger->byLink;
  FORETOUCH_CHECK_OR(inWorld, triggers.add(world, volume, options));
  return Done{};
}

Result<Done> watchAll(const WorldFile& file, const std::vector<const Skeleton*>& skeletons,
                      const World& world, Triggers& triggers) {
  for (TriggerId id = 0; id < triggers.numTriggers(); ++id) {
    const FileBody& trigger = file.bodies[slotOf(triggers.body(id))];
    for (const FileWatch& watch : trigger.trigger->watched) {
      FORETOUCH_TRY(const auto watched, watchedOf(file, skeletons, trigger, watch));
      FORETOUCH_CHECK(triggers.watch(world, id, watched));
    }
  }
  return Done{};
}

}  // namespace foretouch::tools
