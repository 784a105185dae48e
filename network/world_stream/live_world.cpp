#include "network/world_stream/live_world.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Bodies that have come and gone stay in a World: beyond so many it is made anew.
constexpr std::size_t kMostSlots = 4096;

constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min();

/// LiveWorld::Due::rank. For a body that is carried: one more each time it waits for its carrier.
constexpr int kIsPose = 0, kIsLetGo = 1, kIsCarried = 2;

Pose poseOf(const RigidPose& rigid) {
  return {{rigid.rotation}, {rigid.translation}};
}

/// The world knows nothing of its place at `untilUs`.
bool isShort(const LiveBody& body, std::int64_t untilUs) {
  return body.slot && !body.isHeldFast && body.toldUntilUs < untilUs;
}

/// Whether a change after `untilUs` must be told now: no pose comes before it, as it is due or one
/// behind it is there, and one is needed; or a pose behind it was told as if there were no change.
/// One that goes is there until then.
bool isNext(const LiveBody& body, const LiveChange& change, std::int64_t untilUs) {
  if (!body.slot || body.isHeldFast || !change.isPresent) return false;
  if (body.toldUntilUs > change.sinceUs) return true;
  return isShort(body, untilUs) && (!body.knots.empty() || body.stateUs >= change.sinceUs);
}

/// Whether its next change has ended, by the one after it, at that instant.
bool isOver(const LiveBody& body, std::int64_t utimeUs) {
  return body.changes.size() > 1 && body.changes[1].sinceUs <= utimeUs;
}

/// Where a body is that hung on one that is gone is not known, until that is back or something else
/// is said of the body.
void loseCarrier(LiveBody& body, const GoneBody& gone, std::int64_t untilUs) {
  for (std::size_t i = 0; i < body.carriers.size(); ++i) {
    if (body.carriers[i].carrier != gone.number) continue;
    const bool isLast = i + 1 == body.carriers.size();
    const std::int64_t fromUs = std::max(gone.sinceUs, body.carriers[i].sinceUs);
    const std::int64_t toUs = isLast ? untilUs : body.carriers[i + 1].sinceUs;
    if (fromUs < toUs) body.addUnknown(kEveryLink, UndecidedReason::Gap, fromUs, toUs);
    if (isLast && body.isUnchangedUntil(gone.sinceUs)) {
      body.changes.push_front(body.carriedSince(gone.sinceUs));
    }
  }
}

RigidPose rigidPoseOf(const Pose& pose) {
  return {pose.rotations[0], pose.translations[0]};
}

}  // namespace

Result<LiveWorld> LiveWorld::make(const WorldSetup& setup, bool holdsStill, std::int64_t fromUs) {
  FollowOptions options;
  options.mostWindows = kMostWindowsPerAdvance;
  FORETOUCH_TRY(auto follower, WorldFollower::start(fromUs, options));
  LiveWorld made(setup, holdsStill, std::move(follower));
  if (hasSolidBodies(setup)) {
    FORETOUCH_TRY(made.solids_, SolidBodies::make(setup, fromUs));
    made.slots_.push_back({kNoBody, kEarliest});
    return made;
  }
  FORETOUCH_TRY(made.world_, World::build(setup.still, setup.options));
  if (setup.ask) FORETOUCH_CHECK(setup.ask(made.world()));
  return made;
}

Result<Done> LiveWorld::show(LiveBodies& bodies, std::int64_t untilUs, std::int64_t timeline,
                             std::vector<ShownBody>& shown) {
  shown.clear();
  if (!solids_) return Done{};
  const auto numberOfSlot = [&](BodyId slot, std::int64_t us) { return numberOf(slot, us); };
  FORETOUCH_CHECK(solids_->tick(untilUs, timeline, numberOfSlot, shown));
  for (const ShownBody& body : shown) {
    const SolidMessage& solid = body.solid;
    const auto known = bodies.find(solid.avatar);
    if (solid.state != SolidState::Placing || known == bodies.end()) continue;
    known->second.addUnknown(kEveryLink, UndecidedReason::Gap, solid.utimeUs - solid.stepUs,
                             solid.utimeUs);
  }
  return Done{};
}

bool LiveWorld::hasRoomFor(std::size_t bodies) const {
  return slots_.size() + bodies <= kMostSlots;
}

std::optional<BodyNumber> LiveWorld::numberOf(BodyId slot, std::int64_t utimeUs) const {
  if (slot < 0) return slot;  // the scene, every body
  if (slotOf(slot) >= slots_.size()) return std::nullopt;
  const Slot& place = slots_[slotOf(slot)];
  if (place.goneUs && utimeUs >= *place.goneUs) return std::nullopt;
  return place.number;
}

bool LiveWorld::comesLater(const Due& x, const Due& y) {
  return std::tie(x.us, x.rank, x.body->number) > std::tie(y.us, y.rank, y.body->number);
}

/// Nothing: all is told until `untilUs`.
std::optional<LiveWorld::Due> LiveWorld::dueOf(LiveBody& body, std::int64_t untilUs) {
  const bool hasKnot = !body.knots.empty();
  // A pose at the very instant of a change is in the frame before it.
  const bool isChange = !body.changes.empty() &&
                        (!hasKnot || body.changes.front().sinceUs < body.knots.front().utimeUs);
  if (isChange) {
    const LiveChange& change = body.changes.front();
    if (change.sinceUs > untilUs && !isNext(body, change, untilUs)) return std::nullopt;
    return Due{change.sinceUs, change.hasCarrier() ? kIsCarried : kIsLetGo, &body};
  }
  if (!hasKnot || (body.knots.front().utimeUs > untilUs && !isShort(body, untilUs))) {
    return std::nullopt;
  }
  return Due{body.knots.front().utimeUs, kIsPose, &body};
}

void LiveWorld::offer(LiveBody& body, std::int64_t untilUs, std::int64_t notBeforeUs) {
  std::optional<Due> due = dueOf(body, untilUs);
  if (!due) return;
  due->us = std::max(due->us, notBeforeUs);
  due_.push_back(*due);
  std::push_heap(due_.begin(), due_.end(), comesLater);
}

void LiveWorld::tell(LiveBodies& bodies, std::int64_t untilUs) {
  for (auto& [number, body] : bodies) offer(body, untilUs, kEarliest);
  tellDue(bodies, untilUs);
  // What was to follow of those that still wait.
  while (!waiting_.empty()) {
    tellWaiting(untilUs);
    tellDue(bodies, untilUs);
  }
  loseRiders(bodies, untilUs);
  for (auto& [number, body] : bodies) holdShort(body, untilUs);
}

void LiveWorld::tellDue(LiveBodies& bodies, std::int64_t untilUs) {
  while (!due_.empty()) {
    std::pop_heap(due_.begin(), due_.end(), comesLater);
    const Due due = due_.back();
    due_.pop_back();
    tellNext(bodies, due, untilUs);
  }
}

void LiveWorld::tellNext(LiveBodies& bodies, const Due& due, std::int64_t untilUs) {
  LiveBody& body = *due.body;
  if (waitsForCarrier(bodies, due, untilUs)) {
    due_.push_back({due.us, due.rank + 1, &body});
    return std::push_heap(due_.begin(), due_.end(), comesLater);
  }
  const bool wasThere = body.slot.has_value();
  if (due.rank == kIsPose) {
    takeKnot(body, body.knots.front());
    body.knots.pop_front();
  } else if (takeChange(bodies, body, body.changes.front(), untilUs)) {
    body.changes.pop_front();
  } else {
    waiting_.push_back(&body);
    return;
  }
  offer(body, untilUs, due.us);
  if (!wasThere && body.slot) wake(body, due.us, untilUs);
}

/// If two bodies change their carriers at one instant, the carrier comes first.
bool LiveWorld::waitsForCarrier(LiveBodies& bodies, const Due& due, std::int64_t untilUs) {
  if (due.rank < kIsCarried || due.rank > kIsCarried + kMostCarriers) return false;
  const auto carrier = bodies.find(due.body->changes.front().carrier);
  if (carrier == bodies.end()) return false;
  const auto next = dueOf(carrier->second, untilUs);
  return next && next->us == due.us && next->rank == kIsCarried;
}

/// `carrier` is there from `utimeUs` on: what waits for it goes on.
void LiveWorld::wake(const LiveBody& carrier, std::int64_t utimeUs, std::int64_t untilUs) {
  const auto waits = [&](const LiveBody* other) {
    return other->changes.front().carrier == carrier.number;
  };
  const auto first = std::partition(waiting_.begin(), waiting_.end(), std::not_fn(waits));
  for (auto other = first; other != waiting_.end(); ++other) {
    if (isOver(**other, utimeUs)) giveUp(**other);
    offer(**other, untilUs, utimeUs);
  }
  waiting_.erase(first, waiting_.end());
}

/// No body will carry them by now. A change whose time is over by the next one is given up.
void LiveWorld::tellWaiting(std::int64_t untilUs) {
  const std::vector<LiveBody*> waiting = std::exchange(waiting_, {});
  for (LiveBody* const body : waiting) {
    if (!isOver(*body, untilUs)) {
      markSince(*body, body->changes.front(), untilUs);
      continue;
    }
    giveUp(*body);
    offer(*body, untilUs, kEarliest);
  }
}

void LiveWorld::loseRiders(LiveBodies& bodies, std::int64_t untilUs) {
  for (const GoneBody& gone : gone_) {
    for (auto& [number, body] : bodies) loseCarrier(body, gone, untilUs);
  }
}

/// Fills in what its stream has not said until `untilUs`.
void LiveWorld::holdShort(LiveBody& body, std::int64_t untilUs) {
  if (!isShort(body, untilUs)) return;
  body.addUnknown(kEveryLink, UndecidedReason::Gap, body.toldUntilUs, untilUs);
  if (!holdsStill_) return;
  const Pose still = body.told;
  push(body, untilUs, still);
  body.isElsewhere = true;
}

/// The change cannot be followed; poses beyond it may have been told as if it were none.
void LiveWorld::markSince(LiveBody& body, const LiveChange& change, std::int64_t untilUs) {
  const bool isBeyond = body.slot && body.toldUntilUs > change.sinceUs;
  const std::int64_t fromUs = isBeyond ? std::min(body.toldFromUs, change.sinceUs) : change.sinceUs;
  if (fromUs < untilUs) body.addUnknown(kEveryLink, UndecidedReason::Gap, fromUs, untilUs);
}

/// The body's next change, which could not be followed, has ended by the one after it. What was
/// said in between is of no use.
void LiveWorld::giveUp(LiveBody& body) {
  const std::int64_t endUs = body.changes[1].sinceUs;
  body.addUnknown(kEveryLink, UndecidedReason::Gap, body.changes[0].sinceUs, endUs);
  while (!body.knots.empty() && body.knots.front().utimeUs <= endUs) body.knots.pop_front();
  body.changes.pop_front();
}

Result<BodyId> LiveWorld::add(const LiveBody& body, const BodyOptions& options) {
  const WorldShape& shape = setup_->shapes[body.shape];
  if (const SolidOptions* const solid = solidOptionsOf(*setup_, body.number); solid != nullptr) {
    return solids_->add(body.number, shape, *solid, options);
  }
  return shape.avatar ? world().add(*shape.avatar, options) : world().add(*shape.mesh, options);
}

/// False if the world does not take it.
bool LiveWorld::addTo(LiveBody& body) {
  if (body.slot) return true;
  const WorldShape& shape = setup_->shapes[body.shape];
  BodyOptions options;
  options.group = shape.group;
  options.whenSilent = WhenSilent::Undecided;  // the watermark decides who is waited for
  options.self = shape.self;
  const auto added = add(body, options);
  if (!added.ok()) {
    ++failures_;
    return false;
  }
  body.slot = added.value();
  slots_.push_back({body.number, std::nullopt});
  return true;
}

/// `knot`: the pose is its.
void LiveWorld::push(LiveBody& body, std::int64_t utimeUs, const Pose& pose, const LiveKnot* knot) {
  const bool isNew = !body.slot;
  if (!addTo(body)) return;
  if (body.isSolid) {
    knot != nullptr ? solids_->follow(*body.slot, *knot) : solids_->hold(*body.slot, utimeUs);
  } else if (!world().push(*body.slot, utimeUs, pose).ok()) {
    ++failures_;
    body.addUnknown(kEveryLink, UndecidedReason::Gap, body.toldUntilUs, utimeUs);
    body.isElsewhere = true;
    return;
  }
  if (isNew) body.beginUs = utimeUs;
  if (body.isElsewhere) {
    body.addUnknown(kEveryLink, UndecidedReason::Gap, body.toldUntilUs, utimeUs);
  }
  body.isElsewhere = false;
  body.toldFromUs = body.toldUntilUs;
  body.toldUntilUs = utimeUs;
  body.told = pose;
}

void LiveWorld::takeKnot(LiveBody& body, const LiveKnot& knot) {
  if (body.isHeldFast) return;
  if (body.slot && knot.utimeUs <= body.toldUntilUs) {
    // Its state said where it is, and its poses go on from there.
    if (knot.pose && !body.isAvatar && knot.utimeUs == body.toldUntilUs &&
        isSamePose(rigidPoseOf(*knot.pose), rigidPoseOf(body.told))) {
      body.isElsewhere = false;
    }
    return;
  }
  if (knot.pose) {
    push(body, knot.utimeUs, *knot.pose, &knot);
  } else if (body.slot) {
    const Pose still = body.told;
    push(body, knot.utimeUs, still);
  }
}

/// It is not known where it was from its last pose on.
void LiveWorld::holdUntil(LiveBody& body, std::int64_t utimeUs) {
  if (!body.slot || body.isHeldFast || body.toldUntilUs >= utimeUs) return;
  body.addUnknown(kEveryLink, UndecidedReason::Gap, body.toldUntilUs, utimeUs);
  const Pose still = body.told;
  push(body, utimeUs, still);
}

bool LiveWorld::takeChange(LiveBodies& bodies, LiveBody& body, LiveChange& change,
                           std::int64_t untilUs) {
  const std::int64_t saidUs = change.sinceUs;
  const bool isFree = change.isPresent && change.carrier == kNoBody;
  // A pose of that instant has said so.
  if (body.slot && isFree && body.carriers.empty() && saidUs <= body.beginUs) return true;
  // Nothing changes where it has only just begun.
  if (body.slot) {
    const std::int64_t begunUs =
        body.carriers.empty() ? body.beginUs : body.carriers.back().sinceUs;
    change.sinceUs = std::max(change.sinceUs, begunUs + 1);
  }
  bool isTaken = true;
  if (!change.isPresent && change.sinceUs > untilUs) {
    isTaken = false;
  } else if (!change.isPresent) {
    holdUntil(body, change.sinceUs);
    retire(body, change.sinceUs);
  } else if (change.carrier == kNoBody) {
    letGo(body, change);
  } else {
    isTaken = attach(bodies, body, change, untilUs);
  }
  // Also if put off for a later answer: that one does not know since when it was said.
  if (change.sinceUs > saidUs) {
    body.addUnknown(kEveryLink, UndecidedReason::Gap, saidUs, change.sinceUs);
  }
  return isTaken;
}

bool LiveWorld::attach(LiveBodies& bodies, LiveBody& body, LiveChange& change,
                       std::int64_t untilUs) {
  const auto carrier = bodies.find(change.carrier);
  if (carrier == bodies.end() || !isThere(carrier->second)) return false;
  change.sinceUs = std::max(change.sinceUs, carrier->second.beginUs);
  if (change.sinceUs > untilUs && !isNext(body, change, untilUs)) return false;
  holdUntil(body, change.sinceUs);
  const bool isNew = !body.slot;
  if (!addTo(body)) return true;
  const Carrier by{*carrier->second.slot, change.link, change.movesInFrame};
  const Pose pose = poseOf(change.pose);
  if (!world().attach(*body.slot, by, change.sinceUs, pose).ok()) {
    notTaken(body);
    return true;
  }
  if (isNew) body.beginUs = change.sinceUs;
  changed(body, change);
  // It is not known which of its poses is heard first.
  if (isNew && change.movesInFrame) body.isElsewhere = true;
  return true;
}

/// The world was told so.
void LiveWorld::changed(LiveBody& body, const LiveChange& change) {
  // What was told beyond the change was said in another frame.
  const bool isBeyond = !body.isHeldFast && body.toldUntilUs > change.sinceUs;
  if (isBeyond) {
    body.addUnknown(kEveryLink, UndecidedReason::Gap, body.toldFromUs, body.toldUntilUs);
  }
  body.isElsewhere = isBeyond || !change.hasPlace();
  body.toldUntilUs = change.sinceUs;
  body.told = poseOf(change.pose);
  body.isHeldFast = !change.awaitsPoses();
  body.carriers.push_back({change.sinceUs, change.carrier, change.link});
}

/// No body carries it from here on; or its state says that it is here.
void LiveWorld::letGo(LiveBody& body, const LiveChange& change) {
  const bool isCarried = !body.carriers.empty() && body.carriers.back().carrier != kNoBody;
  const Pose pose = poseOf(change.pose);
  if (!body.slot) {
    push(body, change.sinceUs, pose);
    body.isElsewhere = true;  // not known which of its poses is heard first
    return;
  }
  if (!isCarried) return letGoUnheard(body, change);
  holdUntil(body, change.sinceUs);
  if (!world().detach(*body.slot, change.sinceUs, pose).ok()) return notTaken(body);
  changed(body, change);
}

/// For the world it goes on as before its change, which is wrong.
void LiveWorld::notTaken(LiveBody& body) {
  ++failures_;
  body.isElsewhere = true;
  body.isHeldFast = false;  // so it is said to be unknown
}

/// No body carries it since then: so one did before, which was not heard.
void LiveWorld::letGoUnheard(LiveBody& body, const LiveChange& change) {
  const std::int64_t untilUs = body.toldUntilUs;
  body.addUnknown(kEveryLink, UndecidedReason::Gap, std::min(untilUs, change.sinceUs),
                  std::max(untilUs, change.sinceUs));
  if (change.sinceUs > untilUs) push(body, change.sinceUs, poseOf(change.pose));
  body.isElsewhere = change.sinceUs <= untilUs || !change.hasPlace();
}

void LiveWorld::retire(LiveBody& body, std::int64_t utimeUs) {
  if (body.slot) slots_[slotOf(*body.slot)].goneUs = utimeUs;
  gone_.push_back({body.number, utimeUs});
}

}  // namespace foretouch::internal
