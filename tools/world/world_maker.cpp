#include "tools/world/world_maker.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/near_names.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kNeverUs = std::numeric_limits<std::int64_t>::max();

/// A body's change of carrier.
struct DueChange {
  BodyId body = 0;
  std::size_t index = 0;  ///< Among the body's changes.
  const FileChange* file = nullptr;
  std::optional<Carrier> carrier;  ///< From then on.
  bool stays = false;              ///< Where it was just before: `before`, in W.
  Pose before;
};
using DueChanges = std::vector<DueChange>;

/// Gives a world and its loaded bodies the places of all bodies, change after change.
class WorldMaker {
 public:
  WorldMaker(LoadedWorld& loaded, std::vector<BodyKnots> knots)
      : loaded_(loaded),
        knots_(std::move(knots)),
        taken_(knots_.size(), 0),
        stretches_(loaded.stretches()) {
    for (const FileBody& body : loaded.file.bodies) names_.push_back(body.name);
  }

  Result<Done> make() {
    findTimes();
    for (BodyId body = 0; body < numBodies(); ++body) FORETOUCH_CHECK(begin(body));
    DueChanges due = allChanges();
    for (auto first = due.begin(); first != due.end();) {
      const auto isOfInstant = [&](const DueChange& other) {
        return other.file->utimeUs == first->file->utimeUs;
      };
      const auto next = std::find_if_not(first, due.end(), isOfInstant);
      FORETOUCH_CHECK(changeAt(first->file->utimeUs, {first, next}));
      first = next;
    }
    takePoses();
    return Done{};
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(knots_.size()); }
  [[nodiscard]] const FileBody& fileOf(BodyId body) const {
    return loaded_.file.bodies[slotOf(body)];
  }
  [[nodiscard]] LoadedBody& bodyOf(BodyId body) { return loaded_.bodies[slotOf(body)]; }
  [[nodiscard]] const std::string& nameOf(BodyId body) const { return names_[slotOf(body)]; }
  [[nodiscard]] bool stands(BodyId body) const { return knots_[slotOf(body)].knots.empty(); }
  /// The pose of a body that stands, before anything carries it.
  [[nodiscard]] Pose poseOfStanding(BodyId body) const {
    const Skeleton& skeleton = loaded_.bodies[slotOf(body)].shape.skeleton;
    return movedBy(fileOf(body).place.value_or(RigidPose{}), skeleton, restPose(skeleton));
  }
  /// Whether a pose is given for the very instant, and is in no stretch.
  [[nodiscard]] bool hasPoseAt(BodyId body, std::int64_t utimeUs) const {
    const auto& knots = knots_[slotOf(body)].knots;
    const std::size_t next = taken_[slotOf(body)];
    return next < knots.size() && knots[next].utimeUs == utimeUs;
  }
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
  DueChanges allChanges() const;
  Result<Done> changeAt(std::int64_t utimeUs, DueChanges due);
  Result<Pose> poseBefore(BodyId body, const FileChange& change) const;
  Error circleError(const DueChanges& due, const std::vector<BodyId>& circle) const;
  Result<DueChanges> carriersFirst(const DueChanges& due) const;
  Result<Done> tell(const DueChange& due);
  Result<Carrier> carrierOf(BodyId body, const FileChange& change) const;
  Pose poseOf(const DueChange& due);
  Result<Done> push(BodyId body, std::int64_t utimeUs, const Pose& pose, const std::string& file,
                    std::int64_t line);
  Result<Done> pushUntil(BodyId body, std::int64_t untilUs);
  void takePoses();

  LoadedWorld& loaded_;
  std::vector<BodyKnots> knots_;
  std::vector<std::size_t> taken_;  // per body: knots that it has taken
  std::vector<const BodyStretches*> stretches_;
  std::vector<std::string> names_;
};

/// From the first to the last instant at which those that move are known. Those that stand are
/// taken to stand until then.
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
    const std::int64_t lastUs = knots.back().utimeUs;
    const bool isNamedFirst = lastUs == firstToEnd && nameOf(body) < nameOf(*loaded_.waitsFor);
    if (lastUs < firstToEnd || isNamedFirst) loaded_.waitsFor = body;
    firstToEnd = std::min(firstToEnd, lastUs);
  }
  if (first == kNeverUs) first = last = 0;
  loaded_.beginUs = first;
  loaded_.endUs = std::max(first + 1, std::min(last, firstToEnd));
  if (last <= loaded_.endUs) loaded_.waitsFor.reset();
}

/// Begins a body, until its first change of carrier, if it is there before.
Result<Done> WorldMaker::begin(BodyId body) {
  const std::int64_t untilUs = changeUs(body, 0);
  const auto& knots = knots_[slotOf(body)].knots;
  const std::int64_t firstUs = stands(body) ? loaded_.beginUs : knots.front().utimeUs;
  if (firstUs >= untilUs) return Done{};
  bodyOf(body).stretches.push_back({firstUs, std::nullopt, Track(bodyOf(body).shape.skeleton)});
  if (stands(body)) {
    FORETOUCH_CHECK(
        push(body, firstUs, poseOfStanding(body), loaded_.file.path, fileOf(body).line));
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

/// Pushes all knots of the body until the instant, that included.
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
                      inQuotes(nameOf(body)), inQuotes(nameOf(stretch.carrier->body)),
                      LoadedWorld::secondsOf(knot.utimeUs)));
    }
    FORETOUCH_CHECK(push(body, knot.utimeUs, knot.pose, told.file, knot.line));
  }
  return Done{};
}

Result<Carrier> WorldMaker::carrierOf(BodyId body, const FileChange& change) const {
  const auto found = std::find(names_.begin(), names_.end(), change.carrier);
  if (found == names_.end()) {
    return Error::inLine(loaded_.file.path, change.line, ErrorCode::UnknownName,
                         fileOf(body).title("attach") + " to: expected the name of a body, found " +
                             inQuotes(change.carrier) + didYouMean(change.carrier, names_));
  }
  Carrier carrier;
  carrier.body = static_cast<BodyId>(found - names_.begin());
  carrier.movesInFrame = change.movesInFrame;
  if (carrier.body == body) {
    return Error::inLine(loaded_.file.path, change.line, ErrorCode::BadHierarchy,
                         fileOf(body).title("attach") + " to: expected another body than " +
                             inQuotes(change.carrier) + " itself");
  }
  const Skeleton& skeleton = loaded_.bodies[slotOf(carrier.body)].shape.skeleton;
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

/// All changes by time and name.
DueChanges WorldMaker::allChanges() const {
  DueChanges due;
  for (BodyId body = 0; body < numBodies(); ++body) {
    const auto& changes = fileOf(body).changes;
    for (std::size_t i = 0; i < changes.size(); ++i)
      due.push_back({body, i, &changes[i], {}, false, {}});
  }
  std::sort(due.begin(), due.end(), [&](const DueChange& x, const DueChange& y) {
    return std::tie(x.file->utimeUs, nameOf(x.body)) < std::tie(y.file->utimeUs, nameOf(y.body));
  });
  return due;
}

/// All changes of an instant happen at once: a body that stays stays where all bodies were just
/// before, and carriers are where they are from then on.
Result<Done> WorldMaker::changeAt(std::int64_t utimeUs, DueChanges due) {
  for (DueChange& one : due) {
    if (one.file->isAttached) {
      FORETOUCH_TRY(one.carrier, carrierOf(one.body, *one.file));
    }
    one.stays = !one.file->pose && !hasPoseAt(one.body, utimeUs);
    if (!one.stays) continue;
    FORETOUCH_TRY(one.before, poseBefore(one.body, *one.file));
  }
  FORETOUCH_TRY(const auto ordered, carriersFirst(due));
  for (const DueChange& one : ordered) FORETOUCH_CHECK(tell(one));
  return Done{};
}

/// The body's pose in W just before.
Result<Pose> WorldMaker::poseBefore(BodyId body, const FileChange& change) const {
  const LoadedBody& loaded = loaded_.bodies[slotOf(body)];
  if (loaded.stretches.empty()) {
    if (stands(body)) return poseOfStanding(body);
    return Error::inLine(
        loaded_.file.path, change.line, ErrorCode::Empty,
        fmt::format("expected a position: {} is not there before {} s", inQuotes(nameOf(body)),
                    LoadedWorld::secondsOf(change.utimeUs)));
  }
  const BodyPlaces places(stretches_);
  return movedBy(places.carrierAt(body, change.utimeUs), loaded.shape.skeleton,
                 places.poseAt(body, change.utimeUs));
}

/// An error about the first body by name that changes.
Error WorldMaker::circleError(const DueChanges& due, const std::vector<BodyId>& circle) const {
  const auto change = std::find_if(due.begin(), due.end(), [&](const DueChange& one) {
    return std::find(circle.begin(), circle.end(), one.body) != circle.end();
  });
  return Error::inLine(
      loaded_.file.path, change->file->line, ErrorCode::BadHierarchy,
      fmt::format("{} carries {}, itself or through others, at {} s; expected a "
                  "carrier that does not hang on it",
                  inQuotes(nameOf(change->body)), inQuotes(nameOf(change->carrier->body)),
                  LoadedWorld::secondsOf(change->file->utimeUs)));
}

/// Changes of one instant, those of carriers before those of what they carry from then on, so that
/// the carrier is there when the change is made. Refuses circles.
Result<DueChanges> WorldMaker::carriersFirst(const DueChanges& due) const {
  DueChanges ordered;
  std::set<BodyId> known;
  const auto changeOf = [&](BodyId body) {
    return std::find_if(due.begin(), due.end(),
                        [&](const DueChange& one) { return one.body == body; });
  };
  const auto carrierAfter = [&](BodyId body) -> std::optional<BodyId> {
    const auto change = changeOf(body);
    const BodyStretch* const now =
        stretchAt(loaded_.bodies[slotOf(body)].stretches, due.front().file->utimeUs);
    std::optional<Carrier> carrier;
    if (change != due.end()) {
      carrier = change->carrier;
    } else if (now != nullptr) {
      carrier = now->carrier;
    }
    return carrier ? std::optional<BodyId>(carrier->body) : std::nullopt;
  };
  for (const DueChange& one : due) {
    std::vector<BodyId> chain;
    std::optional<BodyId> next = one.body;
    while (next && known.insert(*next).second) {
      chain.push_back(*next);
      next = carrierAfter(*next);
    }
    const auto circle = next ? std::find(chain.begin(), chain.end(), *next) : chain.end();
    if (circle != chain.end()) return circleError(due, {circle, chain.end()});
    for (auto body = chain.rbegin(); body != chain.rend(); ++body) {
      if (const auto change = changeOf(*body); change != due.end()) ordered.push_back(*change);
    }
  }
  return ordered;
}

/// As the file says; else the pose that it has for that very instant; else where the body was.
Pose WorldMaker::poseOf(const DueChange& due) {
  const Skeleton& skeleton = bodyOf(due.body).shape.skeleton;
  const FileChange& change = *due.file;
  if (change.pose) {
    if (skeleton.numJoints() == 1) {
      return Pose{{change.pose->rotation}, {change.pose->translation}};
    }
    return movedBy(*change.pose, skeleton, restPose(skeleton));
  }
  if (!due.stays) return knots_[slotOf(due.body)].knots[taken_[slotOf(due.body)]++].pose;
  const BodyPlaces places(stretches_);
  // Where the carrier is not there, the world refuses.
  if (!due.carrier || !places.isThere(due.carrier->body, change.utimeUs)) return due.before;
  const RigidPose link = places.linkAt(due.carrier->body, due.carrier->link, change.utimeUs);
  return movedBy(inverse(link), skeleton, due.before);
}

Result<Done> WorldMaker::tell(const DueChange& due) {
  const FileChange& change = *due.file;
  const Pose pose = poseOf(due);
  const Skeleton& skeleton = bodyOf(due.body).shape.skeleton;
  const auto refused = [&](const Error& error) { return atLine(change.line, error); };
  FORETOUCH_CHECK_OR(refused,
                     change.isAttached
                         ? loaded_.world.attach(due.body, *due.carrier, change.utimeUs, pose)
                         : loaded_.world.detach(due.body, change.utimeUs, pose));
  BodyStretches& stretches = bodyOf(due.body).stretches;
  stretches.push_back({change.utimeUs, due.carrier, Track(skeleton)});
  FORETOUCH_CHECK_OR(refused, stretches.back().track.push(change.utimeUs, pose));
  return pushUntil(due.body, changeUs(due.body, due.index + 1));
}

/// Fills in the poses of each body, and until when the world itself is known.
void WorldMaker::takePoses() {
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
}

}  // namespace

Result<Done> tellWorld(LoadedWorld& loaded, std::vector<BodyKnots> knots) {
  return WorldMaker(loaded, std::move(knots)).make();
}

}  // namespace foretouch::tools
