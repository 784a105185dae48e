#include "tools/stream/world_publisher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "articulated/quoted.h"
#include "articulated/raw_skeleton.h"
#include "articulated/try.h"
#include "network/wire/codec.h"
#include "tools/world/served_bodies.h"

namespace foretouch::tools {
namespace {

constexpr std::int64_t kEveryUs = 1'000'000;  ///< Skeletons and states are sent again.
constexpr std::int64_t kNeverUs = std::numeric_limits<std::int64_t>::max();
constexpr std::uint8_t kKnown = kJointValid | kJointTracked;

/// At equal times what a body is comes before where it is, and that a body is there before what it
/// carries.
enum class Kind : std::uint8_t { Skeleton, FirstState, State, Pose };

/// What is to be sent when, in time of the world.
struct Due {
  std::int64_t utimeUs = 0;
  Kind kind = Kind::Pose;
  BodyId body = 0;
  int numCarriers = 0;  ///< For a state: carriers come before what they carry.
  /// The queue's top is the first.
  friend bool operator<(const Due& x, const Due& y) {
    return std::tie(y.utimeUs, y.kind, y.numCarriers, y.body) <
           std::tie(x.utimeUs, x.kind, x.numCarriers, x.body);
  }
};

/// One run through a world.
class WorldRun {
 public:
  WorldRun(const LoadedWorld& world, const WorldSetup& setup, const PublishOptions& options,
           Pace& pace, const MessageSink& sink, PublishReport& report)
      : world_(world),
        setup_(setup),
        options_(options),
        pace_(pace),
        sink_(sink),
        report_(report),
        bodies_(world.numBodies()) {}

  /// `startUs`: when the world begins, and the session. False if it was stopped.
  Result<bool> send(std::int64_t startUs) {
    startUs_ = startUs;
    for (std::size_t i = 0; i < bodies_.size(); ++i) begin(static_cast<BodyId>(i));
    while (!due_.empty()) {
      const Due next = due_.top();
      due_.pop();
      const auto lateUs = pace_.waitUntil(stampOf(next.utimeUs) - options_.sender.startUtimeUs);
      if (!lateUs) return false;
      FORETOUCH_CHECK(send(next, *lateUs));
    }
    return true;
  }
  /// Takes all props away.
  Result<Done> end();
  [[nodiscard]] std::int64_t endUs() const { return stampOf(world_.endUs); }

 private:
  struct Body {
    std::int64_t sequence = 0;
    std::int64_t stampUs = std::numeric_limits<std::int64_t>::min();  // its last pose's
    std::size_t posed = 0, said = 0;  // stretches: of its next pose, and of its state
    bool isSaid = false;              // at its instant
    SkeletonMessage skeleton;         // an avatar's
    std::vector<bool> isMoved;        // its joints: sent translations
  };
  [[nodiscard]] const BodyStretches& stretchesOf(BodyId body) const {
    return world_.bodies[slotOf(body)].stretches;
  }
  [[nodiscard]] bool isAvatar(BodyId body) const {
    return !world_.file.bodies[slotOf(body)].shape.avatarPath.empty();
  }
  [[nodiscard]] std::int64_t stampOf(std::int64_t utimeUs) const {
    return startUs_ + std::llround(static_cast<double>(utimeUs - world_.beginUs) / options_.speed);
  }
  /// So much time of the sender in time of the world.
  [[nodiscard]] std::int64_t inWorld(std::int64_t us) const {
    return std::max<std::int64_t>(1, std::llround(static_cast<double>(us) * options_.speed));
  }
  [[nodiscard]] std::int64_t changeUs(BodyId body, std::size_t stretch) const {
    const BodyStretches& all = stretchesOf(body);
    return stretch < all.size() ? all[stretch].beginUs : kNeverUs;
  }

  /// The number of carriers above each other, from where a stretch begins on.
  [[nodiscard]] int numCarriers(const BodyStretch& stretch) const {
    int found = 0;
    for (const BodyStretch* on = &stretch; on != nullptr && on->carrier; ++found) {
      on = stretchAt(stretchesOf(on->carrier->body), stretch.beginUs);
    }
    return found;
  }

  void begin(BodyId body);
  Result<Done> send(const Due& due, std::int64_t lateUs);
  void planPose(BodyId body, std::int64_t afterUs);
  void planState(BodyId body, std::int64_t saidUs);
  Result<Done> sendSkeleton(BodyId body);
  Result<Done> sendState(BodyId body);
  Result<Done> sendPose(BodyId body, std::int64_t utimeUs);
  void fillAvatar(BodyId body, const Pose& pose, std::int64_t stampUs);
  template <typename Message>
  Result<Done> tell(const std::string& channel, const Message& message);

  const LoadedWorld& world_;
  const WorldSetup& setup_;
  const PublishOptions& options_;
  Pace& pace_;
  const MessageSink& sink_;
  PublishReport& report_;
  std::vector<Body> bodies_;
  std::priority_queue<Due> due_;
  std::int64_t startUs_ = 0, stateSequence_ = 0;
  PoseMessage pose_;
  Bytes payload_;
};

template <typename Message>
Result<Done> WorldRun::tell(const std::string& channel, const Message& message) {
  encode(message, payload_);
  FORETOUCH_TRY(const auto taken, sink_(channel, payload_, pace_.utimeUs()));
  report_.failures += taken ? 0 : 1;
  return Done{};
}

void WorldRun::begin(BodyId body) {
  Body& told = bodies_[slotOf(body)];
  const BodyStretch& first = stretchesOf(body).front();
  if (isAvatar(body)) {
    const Avatar& avatar = *world_.bodies[slotOf(body)].shape.avatar;
    told.skeleton.avatar = numberInMessages(slotOf(body));
    told.skeleton.session = startUs_;
    told.skeleton.source = options_.sender.source;
    told.skeleton.skeleton = rawSkeleton(avatar.skeleton());
    told.skeleton.hash = skeletonHash(told.skeleton.skeleton);
    told.isMoved.assign(countOf(avatar.numLinks()), false);
    for (std::int64_t us = first.beginUs; us != kNeverUs; us = first.track.nextKnotUs(us)) {
      const Pose pose = poseOn(first.track, us);
      for (std::size_t j = 0; j < told.isMoved.size(); ++j) {
        const auto joint = static_cast<JointId>(j);
        const bool isRoot = avatar.skeleton().parent(joint) == kNoParent;
        if (isRoot || pose.translations[j] != avatar.skeleton().restOffset(joint)) {
          told.isMoved[j] = true;
        }
      }
    }
    due_.push({first.beginUs, Kind::Skeleton, body, 0});
  } else {
    due_.push({first.beginUs, Kind::FirstState, body, numCarriers(first)});
  }
  // A pose also says where it is first, so that the next one follows on it.
  if (first.isHeldFast() || first.carrier) return planPose(body, first.beginUs);
  due_.push({first.beginUs, Kind::Pose, body, 0});
}

Result<Done> WorldRun::send(const Due& due, std::int64_t lateUs) {
  const std::int64_t countedUs = due.kind == Kind::Pose ? lateUs : 0;
  report_.late += countedUs > PublishReport::kLateUs ? 1 : 0;
  report_.mostLateUs = std::max(report_.mostLateUs, countedUs);
  if (due.kind == Kind::Skeleton) {
    FORETOUCH_CHECK(sendSkeleton(due.body));
    const std::int64_t againUs = due.utimeUs + inWorld(kEveryUs);
    if (againUs <= world_.endUs) due_.push({againUs, Kind::Skeleton, due.body, 0});
  } else if (due.kind != Kind::Pose) {
    FORETOUCH_CHECK(sendState(due.body));
    planState(due.body, due.utimeUs);
  } else {
    FORETOUCH_CHECK(sendPose(due.body, due.utimeUs));
    planPose(due.body, due.utimeUs);
  }
  return Done{};
}

/// Its next pose: in its stretch, or the first one after the begin of the next stretch with poses.
void WorldRun::planPose(BodyId body, std::int64_t afterUs) {
  Body& told = bodies_[slotOf(body)];
  const BodyStretches& stretches = stretchesOf(body);
  for (; told.posed < stretches.size(); ++told.posed) {
    const BodyStretch& stretch = stretches[told.posed];
    const std::int64_t fromUs = std::max(afterUs, stretch.beginUs);
    // A pose at the instant of a change is in the frame before it.
    const std::int64_t untilUs = std::min(stretch.track.knownUntilUs(), world_.endUs);
    if (stretch.isHeldFast() || fromUs >= untilUs) continue;
    const std::int64_t nextUs = stretch.track.nextKnotUs(fromUs);
    due_.push({std::min({nextUs, fromUs + inWorld(kMostQuietUs), untilUs}), Kind::Pose, body, 0});
    return;
  }
}

/// Plans when it next says its state after it has said it then, and for which stretch.
void WorldRun::planState(BodyId body, std::int64_t saidUs) {
  Body& told = bodies_[slotOf(body)];
  const std::int64_t changeAtUs = changeUs(body, told.said);
  // What was sent ahead is sent again where it takes effect.
  std::int64_t nextUs = saidUs < changeAtUs ? changeAtUs : saidUs + inWorld(kEveryUs);
  const std::int64_t followingUs = changeUs(body, told.said + 1);
  std::int64_t aheadUs = kNeverUs;
  if (followingUs != kNeverUs) {
    aheadUs = std::max(saidUs, followingUs - inWorld(kAnnouncedUs));
    // No receiver has heard of a carrier that is not there yet.
    const auto& carrier = stretchesOf(body)[told.said + 1].carrier;
    if (carrier) aheadUs = std::max(aheadUs, stretchesOf(carrier->body).front().beginUs);
  }
  if (aheadUs <= nextUs) {
    ++told.said;
    nextUs = aheadUs;
  }
  if (nextUs > world_.endUs) return;
  due_.push({nextUs, Kind::State, body, numCarriers(stretchesOf(body)[told.said])});
}

Result<Done> WorldRun::sendSkeleton(BodyId body) {
  SkeletonMessage& skeleton = bodies_[slotOf(body)].skeleton;
  skeleton.sendUtimeUs = pace_.utimeUs();
  ++report_.skeletons;
  return tell(options_.channels.skeleton, skeleton);
}

Result<Done> WorldRun::sendState(BodyId body) {
  const BodyStretch& stretch = stretchesOf(body)[bodies_[slotOf(body)].said];
  const Pose place = poseOn(stretch.track, stretch.beginUs);
  BodyMessage message;
  message.body = numberInMessages(slotOf(body));
  message.session = startUs_;
  message.sequence = stateSequence_++;
  message.utimeUs = message.sendUtimeUs = pace_.utimeUs();
  message.shape = world_.nameOf(body);
  message.shapeHash = shapeHash(setup_.shapes[slotOf(body)]);
  if (stretch.carrier) {
    message.carrier = numberInMessages(slotOf(stretch.carrier->body));
    message.carrierLink = stretch.carrier->link;
    message.movesInFrame = stretch.carrier->movesInFrame;
  }
  message.pose = {place.rotations[0], place.translations[0]};
  message.sinceUs = stampOf(stretch.beginUs);
  ++report_.states;
  return tell(options_.channels.body, message);
}

void WorldRun::fillAvatar(BodyId body, const Pose& pose, std::int64_t stampUs) {
  const Body& told = bodies_[slotOf(body)];
  pose_.avatar = told.skeleton.avatar;
  pose_.session = startUs_;
  pose_.utimeUs = stampUs;
  pose_.sendUtimeUs = pace_.utimeUs();
  pose_.skeletonHash = told.skeleton.hash;
  pose_.joints.clear();
  pose_.translations.clear();
  for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
    const auto joint = static_cast<JointId>(j);
    pose_.joints.push_back({joint, kKnown, pose.rotations[j]});
    if (told.isMoved[j]) pose_.translations.push_back({joint, pose.translations[j]});
  }
}

Result<Done> WorldRun::sendPose(BodyId body, std::int64_t utimeUs) {
  Body& told = bodies_[slotOf(body)];
  const BodyStretches& stretches = stretchesOf(body);
  const Pose pose = poseOn(stretches[told.posed].track, utimeUs);
  // At a high speed two poses may be of one microsecond.
  told.stampUs = std::max(told.stampUs + 1, stampOf(utimeUs));
  ++report_.poses;
  if (isAvatar(body)) {
    fillAvatar(body, pose, told.stampUs);
    pose_.sequence = told.sequence++;
    return tell(options_.channels.pose, pose_);
  }
  RigidPoseMessage message;
  // All messages of a session list the same bodies.
  message.session = startUs_ + body;
  message.sequence = told.sequence++;
  message.utimeUs = told.stampUs;
  message.sendUtimeUs = pace_.utimeUs();
  message.bodies = {
      {numberInMessages(slotOf(body)), kKnown, {pose.rotations[0], pose.translations[0]}}};
  return tell(options_.channels.rigidPose, message);
}

Result<Done> WorldRun::end() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const auto body = static_cast<BodyId>(i);
    if (isAvatar(body)) continue;
    BodyMessage message;
    message.body = numberInMessages(i);
    message.session = startUs_;
    message.sequence = stateSequence_++;
    message.utimeUs = message.sendUtimeUs = pace_.utimeUs();
    message.isPresent = false;
    message.shape = world_.nameOf(body);
    message.shapeHash = shapeHash(setup_.shapes[i]);
    message.sinceUs = std::min(message.utimeUs, endUs()) + 1;
    ++report_.states;
    FORETOUCH_CHECK(tell(options_.channels.body, message));
  }
  return Done{};
}

}  // namespace

Result<Done> checkPublished(const LoadedWorld& world) {
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const FileBody& body = world.file.bodies[i];
    const BodyStretches& stretches = world.bodies[i].stretches;
    for (const BodyStretch& stretch : stretches) {
      if (!stretch.carrier || !world.isTrigger(stretch.carrier->body)) continue;
      return Error::inLine(world.file.path, body.line, ErrorCode::Mismatch,
                           body.title("attach") +
                               " to: expected a body: messages do not tell of triggers, as " +
                               inQuotes(world.nameOf(stretch.carrier->body)));
    }
    if (body.shape.avatarPath.empty() || body.changes.empty()) continue;
    return Error::inLine(world.file.path, body.changes.front().line, ErrorCode::Mismatch,
                         body.title("attach") +
                             ": expected a prop: messages do not tell who "
                             "carries an avatar, as " +
                             inQuotes(body.name));
  }
  return Done{};
}

Result<PublishReport> publishWorld(const LoadedWorld& world, const PublishOptions& options,
                                   Pace& pace, const MessageSink& sink) {
  FORETOUCH_CHECK(checkPublished(world));
  const WorldSetup setup = servedBodies(world);
  PublishReport report;
  report.session = options.sender.startUtimeUs;
  std::int64_t startUs = options.sender.startUtimeUs;
  for (;;) {
    WorldRun run(world, setup, options, pace, sink, report);
    FORETOUCH_TRY(const auto isWhole, run.send(startUs));
    if (isWhole && options.loop) {
      startUs = run.endUs() + kMostQuietUs;
      continue;
    }
    FORETOUCH_CHECK(run.end());
    return report;
  }
}

}  // namespace foretouch::tools
