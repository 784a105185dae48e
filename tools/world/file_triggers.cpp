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

Result<Watched> watchedOf(const LoadedWorld& loaded, const FileBody& trigger,
                          const FileWatch& watch) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < loaded.numBodies(); ++i) {
    names.push_back(loaded.file.bodies[i].name);
  }
  const auto found = std::find(names.begin(), names.end(), watch.body);
  if (found == names.end()) {
    return Error::inLine(loaded.file.path, watch.line, ErrorCode::UnknownName,
                         trigger.title("watches") + " body: expected the name of a body, found " +
                             inQuotes(watch.body) + didYouMean(watch.body, names));
  }
  Watched watched;
  watched.body = static_cast<BodyId>(found - names.begin());
  if (watch.link.empty()) return watched;
  const Skeleton& skeleton = loaded.bodies[slotOf(watched.body)].shape.skeleton;
  if (const auto link = skeleton.find(watch.link)) {
    watched.link = *link;
    return watched;
  }
  std::vector<std::string> links;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) links.push_back(skeleton.name(link));
  return Error::inLine(
      loaded.file.path, watch.line, ErrorCode::UnknownName,
      fmt::format("{} link: expected a link of {}, found {}{}", trigger.title("watches"),
                  inQuotes(watch.body), inQuotes(watch.link), didYouMean(watch.link, links)));
}

}  // namespace

Result<Done> addTrigger(const FileBody& file, const BodyShape& shape, LoadedWorld& loaded) {
  const auto inWorld = [&](Error error) {
    return Error::inLine(loaded.file.path, file.line, error.code,
                         file.title() + ": " + error.message);
  };
  FORETOUCH_TRY_OR(inWorld, const auto volume, volumeOf(shape));
  TriggerOptions options;
  options.whenSilent = file.whenSilent;
  options.byLink = file.trigger->byLink;
  FORETOUCH_CHECK_OR(inWorld, loaded.triggers.add(loaded.world, volume, options));
  return Done{};
}

Result<Done> watchAll(LoadedWorld& loaded) {
  for (TriggerId trigger = 0; trigger < loaded.triggers.numTriggers(); ++trigger) {
    const FileBody& file = loaded.file.bodies[slotOf(loaded.triggers.body(trigger))];
    for (const FileWatch& watch : file.trigger->watched) {
      FORETOUCH_TRY(const auto watched, watchedOf(loaded, file, watch));
      FORETOUCH_CHECK(loaded.triggers.watch(loaded.world, trigger, watched));
    }
  }
  return Done{};
}

}  // namespace foretouch::tools
