#include "network/world_stream/solid_bodies.h"

#include <algorithm>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/raw_skeleton.h"
#include "articulated/track.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "network/stream/avatar_stream.h"
#include "network/stream/solid_answer.h"

namespace foretouch::internal {
namespace {

/// As SolidWorld::tick() has it.
constexpr std::int64_t kLongestTickUs = 10'000'000;

Result<BodyId> addClock(World& world) {
  for (BodyGroup group = 0; group < kNumBodyGroups; ++group) {
    FORETOUCH_CHECK(world.ask(kClockGroup, group, false));
  }
  FORETOUCH_CHECK(world.askStill(kClockGroup, false));
  RawSkeleton raw;
  raw.joints.push_back({"clock", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  constexpr double kRadius = 1e-3;
  const Lss point{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kRadius};
  FORETOUCH_TRY(const auto skeleton, Skeleton::build(raw));
  FORETOUCH_TRY(const auto avatar, Avatar::build(skeleton, {{point}}));
  BodyOptions options;
  options.group = kClockGroup;
  options.whenSilent = WhenSilent::Undecided;
  return world.add(avatar, options);
}

/// What goes within the tick, which begins at `fromUs`, has pressed until then.
void fillPushes(const SolidBodyTick& tick, const Skeleton& skeleton, std::int64_t fromUs,
                const SolidBodies::NumberOf& numberOf, PushesMessage& pushes) {
  pushes.isAssumed = tick.isAssumed;
  for (const SolidBodyContact& contact : tick.contacts) {
    const auto number = numberOf(contact.body, fromUs);
    if (!number) continue;
    if (pushes.contacts.size() == kMaxToldPushes) {
      ++pushes.contactsLeftOut;
      continue;
    }
    ToldPush& told = pushes.contacts.emplace_back();
    told.contact = contact;
    told.contact.body = *number;
    told.linkName = skeleton.name(contact.link);
  }
  for (const SolidCrush& crush : tick.crushes) {
    const auto number = numberOf(crush.body, fromUs);
    if (!number) continue;
    if (pushes.crushes.size() == kMaxToldCrushes) {
      ++pushes.crushesLeftOut;
      continue;
    }
    ToldCrush& told = pushes.crushes.emplace_back();
    told.crush = crush;
    told.crush.body = *number;
    told.linkName = skeleton.name(crush.link);
  }
}

}  // namespace

Result<Done> checkedSolids(const WorldSetup& setup) {
  if (!hasSolidBodies(setup)) return Done{};
  std::size_t count = 0;
  for (const WorldShape& shape : setup.shapes) {
    if (shape.group == kClockGroup) {
      return Error::in("group", ErrorCode::LimitExceeded,
                       "expected at most 31 groups beside solid bodies");
    }
  }
  FORETOUCH_TRY(const auto solids, SolidBodies::make(setup, 0));
  for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
    if (!avatar.solid) continue;
    const WorldShape& shape = setup.shapes[avatar.shape];
    if (shape.self) {
      return Error::in("self", ErrorCode::Mismatch,
                       inQuotes(shape.name) +
                           ": of a solid body, own links are not asked; expected no own links");
    }
    if (++count > kMostSolidBodies) {
      return Error::in("solid", ErrorCode::LimitExceeded,
                       "expected at most " + std::to_string(kMostSolidBodies) +
                           " solid bodies, found " + inQuotes(shape.name) + " as one more");
    }
    const auto added = solids->add(avatar.number, shape, *avatar.solid, {});
    if (added.ok()) continue;
    Error error = added.error();
    error.message = inQuotes(shape.name) + ": " + error.message;
    return error;
  }
  return Done{};
}

Result<std::unique_ptr<SolidBodies>> SolidBodies::make(const WorldSetup& setup,
                                                       std::int64_t fromUs) {
  if (!setup.still) return Error::in("scene", ErrorCode::Empty, "solid bodies expect a scene");
  FORETOUCH_TRY(auto world, SolidWorld::build(*setup.still, fromUs, setup.options));
  if (setup.ask) FORETOUCH_CHECK(setup.ask(world.world()));
  FORETOUCH_TRY(const BodyId clock, addClock(world.world()));
  return std::unique_ptr<SolidBodies>(new SolidBodies(*setup.still, std::move(world), clock));
}

Result<BodyId> SolidBodies::add(BodyNumber number, const WorldShape& shape,
                                const SolidOptions& options, const BodyOptions& body) {
  FORETOUCH_CHECK(checkedJoints(*shape.avatar));
  Solid solid;
  solid.number = number;
  solid.skeleton = shape.avatar->skeleton();
  solid.options = options;
  solid.avatarHash = skeletonHash(rawSkeleton(solid.skeleton));
  FORETOUCH_TRY(solid.body, world_.add(*shape.avatar, options, body));
  solids_.push_back(std::move(solid));
  return solids_.back().body;
}

SolidBodies::Solid& SolidBodies::solidOf(BodyId body) {
  const auto found = std::find_if(solids_.begin(), solids_.end(),
                                  [body](const Solid& solid) { return solid.body == body; });
  FORETOUCH_ASSERT(found != solids_.end());
  return *found;
}

void SolidBodies::follow(BodyId body, const LiveKnot& knot) {
  LiveKnot& last = solidOf(body).knots.emplace_back(knot);
  last.isTracked.resize(knot.pose->rotations.size(), 1);
}

void SolidBodies::hold(BodyId body, std::int64_t utimeUs) {
  std::deque<LiveKnot>& knots = solidOf(body).knots;
  LiveKnot still = knots.back();
  still.utimeUs = utimeUs;
  still.lost = 0;
  knots.push_back(std::move(still));
}

/// Where ticks end: at poses of solid bodies, a millisecond apart or more, as many as there may be.
void SolidBodies::findInstants(std::int64_t untilUs) {
  instants_.clear();
  std::int64_t lastUs = world_.utimeUs();
  for (const Solid& solid : solids_) {
    for (const LiveKnot& knot : solid.knots) instants_.push_back(knot.utimeUs);
  }
  std::sort(instants_.begin(), instants_.end());
  std::size_t count = 0;
  for (const std::int64_t us : instants_) {
    if (us < lastUs + kLeastAdvanceUs || us > untilUs - kLeastAdvanceUs) continue;
    instants_[count++] = lastUs = us;
  }
  const std::size_t most = kMostTicksPerAdvance - 1, all = count;
  for (std::size_t i = 0; all > most && i < most; ++i) instants_[i] = instants_[i * all / most];
  instants_.resize(std::min(all, most));
  instants_.push_back(untilUs);
}

/// Sets its target: where its tracker says that it is then.
void SolidBodies::aim(Solid& solid, std::int64_t utimeUs) {
  std::deque<LiveKnot>& knots = solid.knots;
  const auto count = [&](const LiveKnot& knot) {
    solid.isGap = solid.isGap || knot.isGap;
    solid.lost += std::min(knot.lost, kMostCountedLost);
    solid.hasRoots = solid.hasRoots || knot.areRootsKnown;
  };
  solid.isGap = false;
  solid.lost = 0;
  const bool wasThere = std::exchange(solid.isThere, !knots.empty() && knots[0].utimeUs <= utimeUs);
  if (!solid.isThere) return;
  if (!wasThere) count(knots[0]);
  while (knots.size() > 1 && knots[1].utimeUs <= utimeUs) {
    knots.pop_front();
    count(knots[0]);
  }
  const LiveKnot& from = knots[0];
  solid.isTracked = from.isTracked;
  solid.target = *from.pose;
  if (knots.size() == 1 || from.utimeUs == utimeUs) return;
  const LiveKnot& to = knots[1];
  const TrackPiece piece{from.utimeUs, to.utimeUs, &*from.pose, &*to.pose, false};
  motion_.assign(solid.skeleton, *from.pose, *to.pose);
  partOf(piece, motion_, from.utimeUs, utimeUs, partFrom_, solid.target);
  for (std::size_t joint = 0; joint < to.isTracked.size(); ++joint) {
    if (to.isTracked[joint] == 0) solid.isTracked[joint] = 0;
  }
}

Result<Done> SolidBodies::tickTo(std::int64_t utimeUs) {
  targets_.clear();
  for (Solid& solid : solids_) {
    aim(solid, utimeUs);
    if (!solid.isThere || !solid.hasRoots) continue;
    targets_.push_back({solid.body, &solid.target, &solid.isTracked});
  }
  FORETOUCH_CHECK(world_.tick(utimeUs, targets_, ticks_));
  for (const SolidBodyTick& tick : ticks_) work_ += tick.tick.counters.work;
  return Done{};
}

const SolidBodyTick* SolidBodies::tickOf(BodyId body) const {
  for (const SolidBodyTick& tick : ticks_) {
    if (tick.body == body) return &tick;
  }
  return nullptr;
}

void SolidBodies::fill(Solid& solid, std::int64_t fromUs, std::int64_t timeline,
                       const NumberOf& numberOf, ShownBody& shown) const {
  SolidMessage& message = shown.solid;
  fillSolidHead(solid.number, solid.avatarHash, solid.options, message);
  message.session = solid.knots[0].session;
  message.sequence = solid.knots[0].sequence;
  message.utimeUs = world_.utimeUs();
  message.stepUs = world_.utimeUs() - fromUs;
  message.lost = solid.lost;
  message.kind = !std::exchange(solid.hasShown, true) ? StepKind::First
                 : solid.isGap                        ? StepKind::AcrossGap
                                                      : StepKind::Consecutive;
  PushesMessage& pushes = shown.pushes;
  pushes = {};
  pushes.avatar = message.avatar;
  pushes.session = message.session;
  pushes.sequence = message.sequence;
  pushes.utimeUs = message.utimeUs;
  pushes.stepUs = message.stepUs;
  pushes.timeline = timeline;
  const SolidBodyTick* const tick = tickOf(solid.body);
  if (tick == nullptr) return fillSolidWait(solid.target, solid.isTracked, message);
  fillSolidTick(tick->tick, solid.skeleton, still_, message);
  fillPushes(*tick, solid.skeleton, fromUs, numberOf, pushes);
}

Result<Done> SolidBodies::tick(std::int64_t untilUs, std::int64_t timeline,
                               const NumberOf& numberOf, std::vector<ShownBody>& shown) {
  work_ = 0;
  std::size_t count = 0;
  shown.clear();
  FORETOUCH_CHECK(world().push(clock_, untilUs, RigidPose{}));
  findInstants(untilUs);
  for (std::size_t next = 0; world_.utimeUs() < untilUs;) {
    if (++count > kMostTicksPerAdvance * 2) {
      return Error::in("utime", ErrorCode::LimitExceeded, "expected an advance of fewer ticks");
    }
    while (next + 1 < instants_.size() && instants_[next] <= world_.utimeUs()) ++next;
    const bool isEnough = work_ >= kSolidWorkPerAdvance;
    const std::int64_t fromUs = world_.utimeUs();
    const std::int64_t toUs =
        std::min(isEnough ? untilUs : instants_[next], fromUs + kLongestTickUs);
    FORETOUCH_CHECK(tickTo(toUs));
    for (Solid& solid : solids_) {
      if (solid.isThere) fill(solid, fromUs, timeline, numberOf, shown.emplace_back());
    }
  }
  return Done{};
}

}  // namespace foretouch::internal
