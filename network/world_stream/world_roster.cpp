#include "network/world_stream/world_roster.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "lss/index.h"
#include "network/stream/solid_answer.h"
#include "network/world_stream/carrier_times.h"

namespace foretouch::internal {
namespace {

/// A receipt earlier than the newest one by more than this (us): the service's clock was set back.
/// Threads hand messages over out of order by much less.
constexpr std::int64_t kMostReceiptDisorderUs = 10'000'000;
/// A sender that said nothing for so long (us) may begin anew, whatever its numbers say.
constexpr std::int64_t kRestartUs = 2'000'000;

bool isSameState(const LiveChange& x, const LiveChange& y) {
  return x.isPresent == y.isPresent && x.carrier == y.carrier && x.link == y.link &&
         x.movesInFrame == y.movesInFrame && x.sinceUs == y.sinceUs;
}

}  // namespace

WorldRoster::WorldRoster(const WorldSetup& setup, const WorldPolicy& policy)
    : setup_(setup), policy_(policy) {
  for (const WorldShape& shape : setup.shapes) {
    shapeOf_.emplace(shape.name, hashes_.size());
    hashes_.push_back(shapeHash(shape));
  }
  for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
    LiveBody body;
    body.number = avatar.number;
    body.shape = avatar.shape;
    body.isAvatar = true;
    body.isSolid = avatar.solid.has_value();
    bodies_.emplace(avatar.number, std::move(body));
  }
}

Reject WorldRoster::refuse(Reject reason) {
  if (reason != Reject::None) ++counts_.rejects[slotOf(reason)];
  return reason;
}

// States.

Reject WorldRoster::take(const BodyMessage& message, std::int64_t receiveUtimeUs) {
  ++counts_.states;
  isNoted_ = false;
  Reject reason = whyNot(message);
  const std::int64_t latestUs = std::max(nowUs_, receiveUtimeUs) + policy_.aheadUs;
  if (reason == Reject::None && message.sinceUs > latestUs) reason = Reject::FutureStamp;
  if (reason != Reject::None) return refuse(reason);
  received(receiveUtimeUs);
  auto [place, isNew] = bodies_.try_emplace(message.body);
  LiveBody& body = place->second;
  if (isNew) {
    body.number = message.body;
    body.shape = shapeOf_.at(message.shape);
    body.firstUs = message.sinceUs;
    body.firstPose = message.pose;
  }
  if (body.isAvatar) return Reject::None;
  body.heardUs = nowUs_;
  body.stateSession = message.session;
  body.stateSequence = message.sequence;
  change(body, message);
  return Reject::None;
}

Reject WorldRoster::whyNot(const BodyMessage& message) const {
  const auto shape = shapeOf_.find(message.shape);
  if (shape == shapeOf_.end()) return Reject::UnknownShape;
  if (message.shapeHash != 0 && message.shapeHash != hashes_[shape->second]) {
    return Reject::BadHash;
  }
  const auto known = bodies_.find(message.body);
  if (known == bodies_.end()) {
    if (message.kind == BodyMessageKind::Avatar) return Reject::UnknownAvatar;
    if (!message.isPresent) return Reject::UnknownBody;
    if (bodies_.size() >= policy_.maxBodies) return Reject::Limit;
    const WorldShape& made = setup_.shapes[shape->second];
    const bool isRigid = made.mesh || made.avatar->numLinks() == 1;
    return isRigid ? carrierFaultOf(message) : Reject::UnknownShape;
  }
  const LiveBody& body = known->second;
  if (body.shape != shape->second) return Reject::UnknownShape;
  if (body.isAvatar != (message.kind == BodyMessageKind::Avatar)) return Reject::BadIndex;
  if (body.isAvatar) return message.isPresent ? Reject::None : Reject::BadIndex;
  if (!body.isOtherSpeaker && nowUs_ - body.heardUs <= kRestartUs) {
    if (message.session < body.stateSession) return Reject::OldSession;
    const bool isSession = message.session == body.stateSession;
    if (isSession && message.sequence == body.stateSequence) return Reject::Duplicate;
    if (isSession && message.sequence < body.stateSequence) return Reject::OutOfOrder;
  }
  if (!body.state.isPresent) return Reject::Late;  // gone, and said so already
  if (body.changes.size() >= kMostWaitingChanges) return Reject::Overrun;
  return carrierFaultOf(message);
}

Reject WorldRoster::carrierFaultOf(const BodyMessage& message) const {
  if (message.carrier == kNoBody) return Reject::None;
  const auto carrier = bodies_.find(message.carrier);
  if (carrier == bodies_.end()) return Reject::UnknownBody;
  if (carrier->second.isSolid) return Reject::SolidCarrier;
  const WorldShape& shape = setup_.shapes[carrier->second.shape];
  const std::int32_t links = shape.avatar ? shape.avatar->numLinks() : 1;
  if (message.carrierLink >= links) return Reject::UnknownBody;
  const std::int64_t sinceUs = std::max(message.sinceUs, earliestChangeUs());
  return carrierFault(bodies_, message.body, message.carrier, sinceUs);
}

/// As early as anything can still take effect.
std::int64_t WorldRoster::earliestChangeUs() const {
  return std::max(nowUs_ - policy_.waitUs, answeredUs_ ? *answeredUs_ + 1 : 0);
}

/// A state that is repeated changes nothing.
void WorldRoster::change(LiveBody& body, const BodyMessage& message) {
  LiveChange change{message.sinceUs,      message.isPresent, message.carrier, message.carrierLink,
                    message.movesInFrame, message.pose,      message.sinceUs};
  const bool isFirst = body.state.sinceUs == 0 && body.changes.empty() && !body.slot;
  if (!isFirst && isSameState(change, body.state)) return;
  body.state = change;
  const std::int64_t floorUs = earliestChangeUs();
  const bool isLate = change.sinceUs < floorUs;
  // Where a body without a carrier was long ago says nothing of where it is.
  if (isLate && isFirst && change.isPresent && change.carrier == kNoBody) return;
  if (isLate) ++counts_.lateChanges;
  change.sinceUs = std::max(change.sinceUs, floorUs);
  if (!body.changes.empty()) {
    change.sinceUs = std::max(change.sinceUs, body.changes.back().sinceUs + 1);
  }
  if (change.sinceUs > message.sinceUs) {
    body.addUnknown(kEveryLink, UndecidedReason::Gap, message.sinceUs, change.sinceUs);
  }
  body.changes.push_back(change);
  // Until then its poses go on as before, and are waited for.
  body.announced.push_back(change);
  body.ripen(nowUs_);
}

// Poses.

Reject WorldRoster::refusePose(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs) {
  if (reason == Reject::None) {
    refused_.accepted(body);
  } else if (body != kNoBody) {
    refused_.refused(body, reason, receiveUtimeUs);
  }
  return refuse(reason);
}

Reject WorldRoster::timeFault(LiveBody& body, std::int64_t utimeUs, std::int64_t receiveUtimeUs) {
  const std::int64_t nowUs = std::max(nowUs_, receiveUtimeUs);
  if (answeredUs_ && utimeUs <= *answeredUs_) {
    // It speaks in time, of what is answered already, as it said nothing before: the others must
    // not go on like that for ever.
    if (utimeUs >= nowUs - policy_.waitUs && !isWaitedFor(body)) {
      body.backUs = *answeredUs_;
      isNoted_ = true;
    }
    return Reject::Late;
  }
  if (utimeUs > nowUs + policy_.aheadUs || utimeUs > kMostUtimeUs) return Reject::FutureStamp;
  // No answer waits for so long.
  return utimeUs < nowUs - std::max(policy_.waitUs, kMostWorldWaitUs) ? Reject::Late : Reject::None;
}

void WorldRoster::keep(LiveBody& body, LiveKnot knot, bool isGap, std::int64_t receiveUtimeUs) {
  received(receiveUtimeUs);
  const bool isKnown = knot.pose.has_value();
  const std::int64_t saidUs = body.saidUntilUs();
  // A silence longer than bodies are waited for is one whether or not others went on meanwhile.
  const bool wasSilent =
      policy_.whenSilent != WhenSilent::Wait && knot.utimeUs - saidUs > policy_.waitUs;
  const bool isPassed = answeredUs_ && saidUs < *answeredUs_;
  const std::int64_t fromUs = body.hasStream ? body.knownUntilUs : saidUs;
  if (saidUs >= 0 && fromUs != knot.utimeUs && (isGap || wasSilent || isPassed)) {
    ++counts_.gaps;
    body.addUnknown(kEveryLink, UndecidedReason::Gap, std::min(fromUs, knot.utimeUs), knot.utimeUs);
  }
  body.backUs = -1;
  body.skips = !isKnown;
  body.hasStream = true;
  body.isOtherSpeaker = false;
  body.isSilent = false;
  body.knownUntilUs = knot.utimeUs;
  body.heardUs = nowUs_;
  body.knots.push_back(std::move(knot));
  ++counts_.taken;
}

Reject WorldRoster::take(const RigidPoseMessage& message, std::int64_t receiveUtimeUs) {
  reasons_.clear();
  isNoted_ = false;
  bool isAny = false;
  for (const BodyPose& told : message.bodies) {
    ++counts_.rigidPoses;
    const auto body = bodies_.find(told.body);
    const bool isThere = body != bodies_.end() && !body->second.isAvatar;
    const Reject reason = refusePose(
        told.body,
        isThere ? take(body->second, told, message, receiveUtimeUs) : Reject::UnknownBody,
        receiveUtimeUs);
    isAny = isAny || reason == Reject::None;
    reasons_.push_back(reason);
  }
  if (isAny) return Reject::None;
  return reasons_.empty() ? Reject::UnknownBody : reasons_.front();
}

Reject WorldRoster::take(LiveBody& body, const BodyPose& told, const RigidPoseMessage& message,
                         std::int64_t receiveUtimeUs) {
  if (!body.state.isPresent && message.utimeUs >= body.state.sinceUs) return Reject::UnknownBody;
  if (!body.hasFrameOf(message.utimeUs, told.pose)) return Reject::UnknownBody;
  if (!body.state.awaitsPoses() && message.utimeUs > body.state.sinceUs) return Reject::HeldFast;
  bool isGap = false;
  const RigidPlace place{message.session, message.sequence, message.utimeUs};
  Reject reason = rigidPlaceFault(body, place, receiveUtimeUs, kRestartUs, isGap);
  if (reason == Reject::None) reason = timeFault(body, message.utimeUs, receiveUtimeUs);
  if (reason == Reject::None && body.knots.size() >= kMostWaitingKnots) reason = Reject::Overrun;
  if (reason != Reject::None) return reason;
  LiveKnot knot{message.utimeUs, std::nullopt};
  if (told.isKnown()) knot.pose = Pose{{told.pose.rotation}, {told.pose.translation}};
  const std::int64_t knownUntilUs = body.knownUntilUs;
  const bool hadStream = body.hasStream;
  keep(body, std::move(knot), isGap, receiveUtimeUs);
  body.session = message.session;
  body.sequence = message.sequence;
  if (!told.isKnown()) {
    const auto reasonOf = (told.flags & kJointValid) == 0 ? UndecidedReason::InvalidJoint
                                                          : UndecidedReason::StaleJoint;
    body.addUnknown(kEveryLink, reasonOf, hadStream ? knownUntilUs : message.utimeUs,
                    message.utimeUs);
  }
  return Reject::None;
}

Reject WorldRoster::take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs) {
  ++counts_.avatarPoses;
  isNoted_ = false;
  const auto found = bodies_.find(avatar);
  if (found == bodies_.end() || !found->second.isAvatar) return refuse(Reject::UnknownAvatar);
  LiveBody& body = found->second;
  Reject reason = timeFault(body, step.utimeToUs, receiveUtimeUs);
  if (reason == Reject::None && body.hasStream && step.utimeToUs <= body.knownUntilUs) {
    reason = Reject::StaleStamp;
  }
  if (reason == Reject::None && body.knots.size() >= kMostWaitingKnots) reason = Reject::Overrun;
  static_cast<void>(refusePose(avatar, reason, receiveUtimeUs));
  if (reason != Reject::None) {
    body.skips = true;
    return reason;
  }
  const bool isGap =
      step.kind != StepKind::Consecutive || body.skips || step.utimeFromUs != body.knownUntilUs;
  const bool hadStream = body.hasStream;
  LiveKnot knot{step.utimeToUs, *step.to, step.session, step.sequenceTo, step.lost, isGap};
  if (body.isSolid && step.unknownJoints != nullptr) {
    const Skeleton& skeleton = setup_.shapes[body.shape].avatar->skeleton();
    knot.areRootsKnown = findTracked(skeleton, *step.unknownJoints, knot.isTracked);
  }
  keep(body, std::move(knot), isGap, receiveUtimeUs);
  body.skips = false;
  const std::int64_t fromUs = hadStream && !isGap ? step.utimeFromUs : step.utimeToUs;
  for (std::size_t link = 0; link < step.unknown->size(); ++link) {
    const UndecidedReason unknown = (*step.unknown)[link];
    if (unknown == UndecidedReason::None) continue;
    body.addUnknown(static_cast<LinkId>(link), unknown, fromUs, step.utimeToUs);
  }
  return Reject::None;
}

void WorldRoster::changeSpeaker(BodyNumber number) {
  const auto body = bodies_.find(number);
  if (body == bodies_.end() || body->second.isAvatar) return;
  body->second.isOtherSpeaker = true;
  body->second.skips = true;
}

// Time.

void WorldRoster::received(std::int64_t receiveUtimeUs) {
  if (nowUs_ - receiveUtimeUs > kMostReceiptDisorderUs) isSetBack_ = true;
  nowUs_ = isSetBack_ ? receiveUtimeUs : std::max(nowUs_, receiveUtimeUs);
}

/// So the watermark stands where it was for at most waitUs: as long as clocks may differ.
bool WorldRoster::isBack(const LiveBody& body) const {
  return body.backUs >= 0 && body.backUs >= nowUs_ - policy_.waitUs;
}

bool WorldRoster::isWaitedFor(const LiveBody& body) const {
  if (isBack(body)) return true;
  if (body.saidUntilUs() < 0 || !body.isAwaited) return false;
  return policy_.whenSilent == WhenSilent::Wait || body.saidUntilUs() >= nowUs_ - policy_.waitUs;
}

std::optional<std::int64_t> WorldRoster::watermark() {
  for (auto& [number, body] : bodies_) body.ripen(nowUs_);
  forgetSilent();
  std::optional<std::int64_t> slowest, latest;
  waitsFor_ = kNoBody;
  for (const auto& [number, body] : bodies_) {
    const std::int64_t saidUs = std::max(body.saidUntilUs(), isBack(body) ? body.backUs : -1);
    if (saidUs < 0) continue;
    latest = latest ? std::max(*latest, saidUs) : saidUs;
    if (!isWaitedFor(body) || (slowest && saidUs >= *slowest)) continue;
    slowest = saidUs;
    waitsFor_ = number;
  }
  const auto furthest = slowest ? slowest : latest;
  // Stamps of what has not happened hurry no body: what is said now is about now.
  return furthest ? std::optional(std::min(*furthest, nowUs_)) : std::nullopt;
}

/// A body that is gone by this makes place for others.
void WorldRoster::forgetSilent() {
  for (auto& [number, body] : bodies_) {
    if (body.isAvatar || !body.state.isPresent || nowUs_ - body.heardUs <= policy_.forgetUs) {
      continue;
    }
    ++counts_.forgotten;
    LiveChange gone = body.state;
    gone.isPresent = false;
    gone.sinceUs = std::max(body.saidUntilUs(), answeredUs_.value_or(0)) + 1;
    if (!body.changes.empty()) {
      gone.sinceUs = std::max(gone.sinceUs, body.changes.back().sinceUs + 1);
    }
    body.state = gone;
    body.changes.push_back(gone);
    body.announced.push_back(gone);
    body.ripen(nowUs_);
  }
}

void WorldRoster::noteSilence(std::int64_t utimeUs) {
  counts_.silent = 0;
  for (auto& [number, body] : bodies_) {
    const std::int64_t saidUs = body.saidUntilUs();
    const bool isBehind = saidUs >= 0 && body.isAwaited && saidUs < utimeUs;
    if (isBehind && !body.isSilent) ++counts_.silences;
    body.isSilent = isBehind;
    if (isBehind) ++counts_.silent;
  }
}

void WorldRoster::answered(std::optional<std::int64_t> utimeUs) {
  if (utimeUs) noteSilence(*utimeUs);
  answeredUs_ = utimeUs;
}

void WorldRoster::beginAnew(std::int64_t fromUs, bool keepsBodies) {
  isSetBack_ = false;
  for (auto& [number, body] : bodies_) {
    const bool isCarried = !body.carriers.empty() && body.carriers.back().carrier != kNoBody;
    // What was announced is to come; it is forgotten with the rest where nothing is kept.
    const std::int64_t againUs =
        isCarried && keepsBodies ? std::max(fromUs + 1, body.carriers.back().sinceUs) : fromUs + 1;
    LiveChange again = isCarried && keepsBodies ? body.carriedSince(againUs) : body.state;
    again.sinceUs = againUs;
    body.carriers.clear();
    body.slot.reset();
    body.isHeldFast = false;
    body.toldUntilUs = -1;
    body.skips = true;
    if (!keepsBodies) {
      body.knots.clear();
      body.changes.clear();
      body.announced.clear();
      body.unknown.clear();
      body.hasStream = false;
      body.knownUntilUs = body.stateUs = body.backUs = body.firstUs = -1;
      body.isSilent = false;
    } else {
      // What the world was told beyond that is forgotten with it.
      const std::int64_t toUs = body.knots.empty() ? body.knownUntilUs : body.knots.front().utimeUs;
      if (toUs > fromUs) body.addUnknown(kEveryLink, UndecidedReason::Gap, fromUs, toUs);
    }
    if (!isCarried || !again.hasCarrier() || !body.isUnchangedUntil(againUs)) continue;
    body.addUnknown(kEveryLink, UndecidedReason::Gap, fromUs, againUs);
    body.changes.push_front(again);
  }
}

}  // namespace foretouch::internal
