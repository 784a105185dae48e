#include "tools/world/loaded_world.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/near_names.h"
#include "lss/index.h"
#include "tools/inputs/own_pairs.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/microseconds.h"
#include "tools/world/body_knots.h"
#include "tools/world/file_triggers.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kNeverUs = std::numeric_limits<std::int64_t>::max();

/// A body's change of carrier, in the order in which the world is told.
struct DueChange {
  std::int64_t utimeUs = 0;
  BodyId body = 0;
  std::size_t index = 0;  ///< Among the body's changes.
};

/// Tells a world and its loaded bodies where everybody is, change after change.
class WorldMaker {
 public:
  WorldMaker(LoadedWorld& loaded, std::vector<BodyKnots> knots)
      : loaded_(loaded),
        knots_(std::move(knots)),
        taken_(knots_.size(), 0),
        stretches_(loaded.stretches()) {}

  Result<Done> make() {
    findTimes();
    for (BodyId body = 0; body < numBodies(); ++body) FORETOUCH_CHECK(begin(body));
    std::vector<DueChange> due;
    for (BodyId body = 0; body < numBodies(); ++body) {
      for (std::size_t i = 0; i < fileOf(body).changes.size(); ++i) {
        due.push_back({fileOf(body).changes[i].utimeUs, body, i});
      }
    }
    std::stable_sort(due.begin(), due.end(),
                     [](const DueChange& x, const DueChange& y) { return x.utimeUs < y.utimeUs; });
    for (const DueChange& change : due) FORETOUCH_CHECK(tell(change));
    return checkAll();
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(knots_.size()); }
  [[nodiscard]] const FileBody& fileOf(BodyId body) const {
    return loaded_.file.bodies[slotOf(body)];
  }
  [[nodiscard]] LoadedBody& bodyOf(BodyId body) { return loaded_.bodies[slotOf(body)]; }
  [[nodiscard]] bool stands(BodyId body) const { return knots_[slotOf(body)].knots.empty(); }
  [[nodiscard]] std::int64_t changeUs(BodyId body, std::size_t index) const {
    const auto& changes = fileOf(body).changes;
    return index < changes.size() ? changes[index].utimeUs : kNeverUs;
  }
  [[nodiscard]] Error atLine(std::int64_t line, Error error) const {
    error = named(std::move(error), loaded_.file);
    error.file = loaded_.file.path;
    error.line = line;
    return error;
  }

  void findTimes();
  Result<Done> begin(BodyId body);
  Result<Done> tell(const DueChange& due);
  Result<Carrier> carrierOf(BodyId body, const FileChange& change);
  Result<Pose> poseOf(BodyId body, const FileChange& change, const Carrier* carrier);
  Result<Done> push(BodyId body, std::int64_t utimeUs, const Pose& pose, const std::string& file,
                    std::int64_t line);
  Result<Done> pushUntil(BodyId body, std::int64_t untilUs);
  Result<Done> checkAll();

  LoadedWorld& loaded_;
  std::vector<BodyKnots> knots_;
  std::vector<std::size_t> taken_;  // per body: knots that it was told
  std::vector<const BodyStretches*> stretches_;
};

/// From the first to the last instant that those who move are known at. Who stands is told to,
/// until then.
void WorldMaker::findTimes() {
  std::int64_t first = kNeverUs, last = -kNeverUs, firstToEnd = kNeverUs;
  for (BodyId body = 0; body < numBodies(); ++body) {
    const auto& knots = knots_[slotOf(body)].knots;
    const auto& changes = fileOf(body).changes;
    if (!changes.empty()) {
      first = std::min(first, changes.front().utimeUs);
      last = std::max(last, changes.back().utimeUs);
    }
    if (knots.empty()) continue;
    first = std::min(first, knots.front().utimeUs);
    last = std::max(last, knots.back().utimeUs);
    const bool isHeld =
        !changes.empty() && changes.back().isAttached && !changes.back().movesInFrame;
    if (fileOf(body).whenSilent != WhenSilent::Wait || isHeld) continue;
    if (knots.back().utimeUs < firstToEnd) loaded_.waitsFor = body;
    firstToEnd = std::min(firstToEnd, knots.back().utimeUs);
  }
  if (first == kNeverUs) first = last = 0;
  loaded_.beginUs = first;
  loaded_.endUs = std::max(first + 1, std::min(last, firstToEnd));
  if (last <= loaded_.endUs) loaded_.waitsFor.reset();
}

/// Until its first change of carrier, if it is there before.
Result<Done> WorldMaker::begin(BodyId body) {
  const std::int64_t untilUs = changeUs(body, 0);
  const auto& knots = knots_[slotOf(body)].knots;
  const std::int64_t firstUs = stands(body) ? loaded_.beginUs : knots.front().utimeUs;
  if (firstUs >= untilUs) return Done{};
  const Skeleton& skeleton = bodyOf(body).shape.skeleton;
  bodyOf(body).stretches.push_back({firstUs, std::nullopt, Track(skeleton)});
  if (stands(body)) {
    const Pose pose =
        movedBy(fileOf(body).place.value_or(RigidPose{}), skeleton, restPose(skeleton));
    FORETOUCH_CHECK(push(body, firstUs, pose, loaded_.file.path, fileOf(body).line));
  }
  return pushUntil(body, untilUs);
}

Result<Done> WorldMaker::push(BodyId body, std::int64_t utimeUs, const Pose& pose,
                              const std::string& file, std::int64_t line) {
  auto pushed = loaded_.world.push(body, utimeUs, pose);
  if (pushed.ok()) pushed = bodyOf(body).stretches.back().track.push(utimeUs, pose);
  if (pushed.ok()) return Done{};
  Error error = named(pushed.error(), loaded_.file);
  error.file = file;
  error.line = line;
  return error;
}

/// All that is told of the body until the instant, that included.
Result<Done> WorldMaker::pushUntil(BodyId body, std::int64_t untilUs) {
  const BodyStretch& stretch = bodyOf(body).stretches.back();
  if (stands(body)) {
    const std::int64_t lastUs = std::min(untilUs, loaded_.endUs);
    if (stretch.isHeldFast() || lastUs <= stretch.track.knownUntilUs()) return Done{};
    const Pose pose = *stretch.track.pieceAt(stretch.track.knownUntilUs()).from;
    return push(body, lastUs, pose, loaded_.file.path, fileOf(body).line);
  }
  const BodyKnots& told = knots_[slotOf(body)];
  for (std::size_t& next = taken_[slotOf(body)];
       next < told.knots.size() && told.knots[next].utimeUs <= untilUs; ++next) {
    const BodyKnot& knot = told.knots[next];
    if (stretch.isHeldFast()) {
      // A pose at the very instant of the change says where the body is then.
      if (knot.utimeUs == untilUs) return Done{};
      return Error::inLine(
          told.file, knot.line, ErrorCode::Mismatch,
          fmt::format("{} is held fast by {} at {} s; expected no pose until it is detached",
                      inQuotes(fileOf(body).name), inQuotes(loaded_.nameOf(stretch.carrier->body)),
                      LoadedWorld::secondsOf(knot.utimeUs)));
    }
    FORETOUCH_CHECK(push(body, knot.utimeUs, knot.pose, told.file, knot.line));
  }
  return Done{};
}

Result<Carrier> WorldMaker::carrierOf(BodyId body, const FileChange& change) {
  std::vector<std::string> names;
  for (const FileBody& other : loaded_.file.bodies) names.push_back(other.name);
  const auto found = std::find(names.begin(), names.end(), change.carrier);
  if (found == names.end()) {
    return Error::inLine(loaded_.file.path, change.line, ErrorCode::UnknownName,
                         fileOf(body).title("attach") + " to: expected the name of a body, found " +
                             inQuotes(change.carrier) + didYouMean(change.carrier, names));
  }
  Carrier carrier;
  carrier.body = static_cast<BodyId>(found - names.begin());
  carrier.movesInFrame = change.movesInFrame;
  if (carrier.body == body) {
    return Error::inLine(loaded_.file.path, change.line, ErrorCode::BadHierarchy,
                         fileOf(body).title("attach") + " to: expected another body than " +
                             inQuotes(change.carrier) + " itself");
  }
  const Skeleton& skeleton = bodyOf(carrier.body).shape.skeleton;
  if (change.link.empty() && skeleton.numJoints() == 1) return carrier;
  if (const auto link = skeleton.find(change.link)) {
    carrier.link = *link;
    return carrier;
  }
  std::vector<std::string> links;
  for (LinkId link = 0; link < skeleton.numJoints(); ++link) links.push_back(skeleton.name(link));
  return Error::inLine(
      loaded_.file.path, change.line, ErrorCode::UnknownName,
      fmt::format("{} link: expected a link of {}, found {}{}", fileOf(body).title("attach"),
                  inQuotes(change.carrier), inQuotes(change.link), didYouMean(change.link, links)));
}

/// As the file says; else a pose that it tells for that very instant; else where the body is.
Result<Pose> WorldMaker::poseOf(BodyId body, const FileChange& change, const Carrier* carrier) {
  const Skeleton& skeleton = bodyOf(body).shape.skeleton;
  if (change.pose) {
    if (skeleton.numJoints() == 1) {
      return Pose{{change.pose->rotation}, {change.pose->translation}};
    }
    return movedBy(*change.pose, skeleton, restPose(skeleton));
  }
  const auto& knots = knots_[slotOf(body)].knots;
  std::size_t& next = taken_[slotOf(body)];
  if (next < knots.size() && knots[next].utimeUs == change.utimeUs) return knots[next++].pose;
  const BodyPlaces places(stretches_);
  if (!places.isThere(body, change.utimeUs)) {
    return Error::inLine(
        loaded_.file.path, change.line, ErrorCode::Empty,
        fmt::format("expected a position: {} is not there before {} s", inQuotes(fileOf(body).name),
                    LoadedWorld::secondsOf(change.utimeUs)));
  }
  Pose pose = places.poseAt(body, change.utimeUs);
  RigidPose frame = places.carrierAt(body, change.utimeUs);
  if (carrier != nullptr && places.isThere(carrier->body, change.utimeUs)) {
    frame = composed(inverse(places.linkAt(carrier->body, carrier->link, change.utimeUs)), frame);
  }
  return movedBy(frame, skeleton, std::move(pose));
}

Result<Done> WorldMaker::tell(const DueChange& due) {
  const FileChange& change = fileOf(due.body).changes[due.index];
  std::optional<Carrier> carrier;
  if (change.isAttached) {
    FORETOUCH_TRY(carrier, carrierOf(due.body, change));
  }
  FORETOUCH_TRY(auto pose, poseOf(due.body, change, carrier ? &*carrier : nullptr));
  const Skeleton& skeleton = bodyOf(due.body).shape.skeleton;
  const auto refused = [&](const Error& error) { return atLine(change.line, error); };
  FORETOUCH_CHECK_OR(refused, validate(skeleton, pose));
  FORETOUCH_CHECK_OR(refused, change.isAttached
                                  ? loaded_.world.attach(due.body, *carrier, due.utimeUs, pose)
                                  : loaded_.world.detach(due.body, due.utimeUs, pose));
  BodyStretches& stretches = bodyOf(due.body).stretches;
  stretches.push_back({due.utimeUs, carrier, Track(skeleton)});
  FORETOUCH_CHECK_OR(refused, stretches.back().track.push(due.utimeUs, pose));
  return pushUntil(due.body, changeUs(due.body, due.index + 1));
}

/// What the world itself is known until; and nobody is left out.
Result<Done> WorldMaker::checkAll() {
  for (BodyId body = 0; body < numBodies(); ++body) {
    LoadedBody& loaded = bodyOf(body);
    const auto& knots = knots_[slotOf(body)].knots;
    loaded.numPoses = knots.size();
    if (!knots.empty()) {
      loaded.firstPoseUs = knots.front().utimeUs;
      loaded.lastPoseUs = knots.back().utimeUs;
    }
    loaded.self = std::move(knots_[slotOf(body)].self);
  }
  const auto knownUs = loaded_.world.knownUntilUs();
  if (knownUs) loaded_.endUs = std::max(loaded_.beginUs + 1, std::min(loaded_.endUs, *knownUs));
  return Done{};
}

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

/// Reads what the body is and what is told of it, and adds it to the world.
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
    return Error::inLine(path, body.line, added.error().code, added.error().message);
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
  FORETOUCH_CHECK(WorldMaker(loaded, std::move(knots)).make());
  return loaded;
}

std::vector<const BodyStretches*> LoadedWorld::stretches() const {
  std::vector<const BodyStretches*> all;
  for (const LoadedBody& body : bodies) all.push_back(&body.stretches);
  return all;
}

std::string LoadedWorld::linkNameOf(BodyId body, LinkId link) const {
  const Skeleton& skeleton = bodies[slotOf(body)].shape.skeleton;
  return skeleton.numJoints() == 1 ? "" : skeleton.name(link);
}

}  // namespace foretouch::tools
