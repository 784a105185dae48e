#include "network/world_stream/world_solver.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "network/world_stream/carrier_times.h"
#include "network/world_stream/live_world.h"
#include "network/world_stream/world_roster.h"

namespace foretouch {
namespace {

using internal::GoneBody;
using internal::LiveBody;
using internal::LiveWorld;
using internal::UnknownSpan;
using internal::WorldRoster;
using WorldClock = std::chrono::steady_clock;

Result<Done> checkedPolicy(const WorldPolicy& policy) {
  const auto refused = [](const char* field, const char* what) {
    return Error::in(field, ErrorCode::OutOfRange, what);
  };
  if (policy.waitUs < 1 || policy.waitUs > kMostWorldWaitUs) {
    return refused("wait", "expected a wait of 1 us to 60 s");
  }
  if (policy.aheadUs < 0 || policy.aheadUs > kMostWorldWaitUs) {
    return refused("ahead", "expected 0 to 60 s");
  }
  if (policy.forgetUs < policy.waitUs) {
    return refused("forget", "expected at least the time that is waited");
  }
  if (policy.maxBodies < 1 || policy.maxBodies > kMaxToldBodies) {
    return refused("bodies", "expected 1 to 4096 bodies");
  }
  return Done{};
}

Result<Done> checkedSetup(const WorldSetup& setup, const WorldPolicy& policy) {
  std::set<std::string> names;
  for (const WorldShape& shape : setup.shapes) {
    if (shape.avatar.has_value() == shape.mesh.has_value()) {
      return Error::in("shape", ErrorCode::Mismatch,
                       inQuotes(shape.name) + ": expected an avatar or a mesh");
    }
    if (!names.insert(shape.name).second) {
      return Error::in(
          "shape", ErrorCode::DuplicateName,
          "expected shapes of different names, found " + inQuotes(shape.name) + " twice");
    }
  }
  std::set<BodyNumber> numbers;
  for (const WorldSetup::ServedAvatar& avatar : setup.avatars) {
    if (avatar.shape >= setup.shapes.size() || !setup.shapes[avatar.shape].avatar) {
      return Error::in("avatar", ErrorCode::UnknownName, "expected the shape of an avatar");
    }
    if (avatar.number < 0 || !numbers.insert(avatar.number).second) {
      return Error::in("avatar", ErrorCode::DuplicateName,
                       "expected avatars of different numbers, none below 0");
    }
  }
  if (setup.avatars.size() > policy.maxBodies) {
    return Error::in("bodies", ErrorCode::LimitExceeded, "expected room for all avatars");
  }
  return Done{};
}

/// How far the watermark should move until the next answer (us), so that no more than half of all
/// time goes by in answering. By what was counted, and not by a clock: a replay does the same.
std::int64_t costOf(const WorldEvents& found, std::size_t bodies, std::uint64_t solidWork) {
  constexpr std::uint64_t kBody = 60, kPair = 50, kEvent = 200, kPerUs = 50, kMostUs = 1'000'000;
  // To tell the world of it, and others of the answer, costs about as much as two windows.
  const std::uint64_t looks = (found.counters.windows + 2) * bodies;
  const std::uint64_t pairs = found.world.pairs + found.counters.pairs;
  const std::uint64_t work =
      looks * kBody + pairs * kPair + found.world.work + found.events.size() * kEvent + solidWork;
  return static_cast<std::int64_t>(std::min(work / kPerUs, kMostUs));
}

bool comesFirst(const ToldEvent& x, const ToldEvent& y) {
  return comesBefore(x.event, y.event);
}

}  // namespace

struct WorldSolver::Impl {
  Impl(WorldSetup given, const WorldPolicy& chosen)
      : setup(std::move(given)), policy(chosen), roster(setup, policy) {}

  const WorldSetup setup;
  const WorldPolicy policy;
  WorldRoster roster;
  std::optional<LiveWorld> world;  // from the first pose on
  std::int64_t fromUs = 0;         // answered until here
  std::int64_t sequence = 0;
  std::int64_t leastAdvanceUs = kLeastAdvanceUs;
  WorldEvents found;
  std::vector<ToldEvent> told;
  std::vector<ShownBody> shown;

  [[nodiscard]] bool holdsStill() const { return policy.whenSilent == WhenSilent::HoldStill; }

  /// Another timeline, from where it is now.
  void begin(std::int64_t utimeUs, bool keepsBodies) {
    auto made = LiveWorld::make(setup, holdsStill(), utimeUs);
    if (!made.ok()) {  // it was made before: memory
      ++roster.counts().failures;
      return;
    }
    if (world) roster.beginAnew(utimeUs, keepsBodies);
    world.emplace(std::move(made).value());
    fromUs = utimeUs;
    roster.answered(utimeUs);
    ++roster.counts().timelines;
  }

  /// Nothing is known before a timeline's first pose.
  [[nodiscard]] std::int64_t firstUs() {
    std::int64_t first = kMostUtimeUs;
    for (const auto& [number, body] : roster.bodies()) {
      if (!body.knots.empty()) first = std::min(first, body.knots.front().utimeUs);
      if (!body.changes.empty()) first = std::min(first, body.changes.front().sinceUs);
    }
    return std::max<std::int64_t>(0, first);
  }

  void advance(std::vector<EventsMessage>& answers) {
    std::size_t count = 0;
    shown.clear();
    if (roster.isSetBack()) {
      roster.beginAnew(0, false);
      world.reset();
      roster.answered(std::nullopt);
    }
    const auto until = roster.watermark();
    // Not before all bodies that begin together have said where they do.
    if (until && !world && *until > firstUs()) begin(firstUs(), true);
    if (until && world && *until - fromUs >= leastAdvanceUs) answerUntil(*until, answers, count);
    answers.resize(count);
  }

  void answerUntil(std::int64_t untilUs, std::vector<EventsMessage>& answers, std::size_t& count) {
    const WorldClock::time_point start = WorldClock::now();
    if (!world->hasRoomFor(roster.bodies().size())) begin(fromUs, true);
    world->tell(roster.bodies(), untilUs);
    const bool isShown = show(untilUs);
    // There may be no body yet: then there is no world to ask.
    const auto knownUs = world->knownUntilUs();
    bool isAnswered = isShown && knownUs && *knownUs >= untilUs;
    if (isAnswered && !world->follow(untilUs, found).ok()) {
      ++roster.counts().failures;
      isAnswered = false;
    }
    told.clear();
    if (isAnswered) {
      leastAdvanceUs =
          std::max(kLeastAdvanceUs, costOf(found, roster.bodies().size(), world->solidWork()));
      translate(untilUs);
    }
    addGone();
    std::sort(told.begin(), told.end(), comesFirst);
    for (const ToldEvent& event : told) {
      ++roster.counts().events[static_cast<std::size_t>(event.event.kind)];
      if (event.event.isAssumed) ++roster.counts().marked;
    }
    ++roster.counts().advances;
    roster.answered(untilUs);
    fill(untilUs, isAnswered, answers, count);
    finish(untilUs, isAnswered);
    const double tookUs =
        std::chrono::duration<double, std::micro>(WorldClock::now() - start).count();
    for (std::size_t i = 0; i < count; ++i) answers[i].worldUs = tookUs;
  }

  /// False: solid bodies could not go on.
  bool show(std::int64_t untilUs) {
    const WorldClock::time_point start = WorldClock::now();
    const auto timeline = static_cast<std::int64_t>(roster.counts().timelines);
    const bool isDone = world->show(roster.bodies(), untilUs, timeline, shown).ok();
    if (!isDone) ++roster.counts().failures;
    const double tookUs =
        std::chrono::duration<double, std::micro>(WorldClock::now() - start).count();
    for (ShownBody& body : shown) body.solid.solidUs = body.pushes.tickUs = tookUs;
    return isDone;
  }

  void finish(std::int64_t untilUs, bool isAnswered) {
    for (const GoneBody& gone : world->gone()) roster.erase(gone.number);
    world->gone().clear();
    for (auto& [number, body] : roster.bodies()) body.forgetBefore(untilUs);
    fromUs = untilUs;
    world->forgetBefore(untilUs);
    // What could not be followed cannot be caught up with.
    if (!isAnswered) begin(untilUs, true);
  }

  /// The events of the bodies that are there, by their numbers.
  void translate(std::int64_t untilUs) {
    static_cast<void>(untilUs);
    for (const WorldEvent& event : found.events) {
      // A body that is gone is not silent.
      const auto a = world->numberOf(event.a.body, event.time.us);
      const auto b = world->numberOf(event.b.body, event.time.us);
      if (!a || !b) continue;
      ToldEvent& next = told.emplace_back();
      next.event = event;
      next.event.a.body = *a;
      next.event.b.body = *b;
      next.cause = event.cause == LeaveCause::NotAsked ? ToldCause::NotAsked : ToldCause::Apart;
      const std::int64_t toUs = event.time.us + (event.time.fraction > 0.0 ? 1 : 0);
      next.event.isAssumed = event.isAssumed ||
                             isUnknown(roster.bodies(), *a, event.a.link, event.time.us, toUs) ||
                             isUnknown(roster.bodies(), *b, event.b.link, event.time.us, toUs);
    }
  }

  void addGone() {
    for (const GoneBody& gone : world->gone()) {
      ToldEvent& next = told.emplace_back();
      next.cause = ToldCause::BodyGone;
      next.event.kind = EventKind::Leave;
      next.event.a.body = gone.number;
      next.event.a.link = next.event.b.link = kEveryLink;
      next.event.b.body = kEveryBody;
      next.event.time = next.event.since = {gone.sinceUs, 0.0};
      next.event.effectiveMass = std::numeric_limits<double>::infinity();
    }
  }

  /// One message, or as many as hold all events.
  void fill(std::int64_t untilUs, bool isAnswered, std::vector<EventsMessage>& answers,
            std::size_t& count) {
    for (std::size_t first = 0; first == 0 || first < told.size(); first += kMaxToldEvents) {
      if (count == answers.size()) answers.emplace_back();
      EventsMessage& answer = answers[count++];
      const std::size_t last = std::min(told.size(), first + kMaxToldEvents);
      answer.timeline = static_cast<std::int64_t>(roster.counts().timelines);
      answer.sequence = sequence++;
      answer.fromUs = fromUs;
      answer.toUs = untilUs;
      answer.hasMore = last < told.size();
      answer.tolerance = setup.options.tolerance;
      answer.events.assign(told.begin() + static_cast<std::ptrdiff_t>(first),
                           told.begin() + static_cast<std::ptrdiff_t>(last));
      fillBodies(answer);
      fillUnknown(isAnswered, answer);
    }
  }

  void fillBodies(EventsMessage& answer) const {
    answer.bodies.clear();
    for (const auto& [number, body] : roster.bodies()) {
      answer.bodies.push_back({number, body.saidUntilUs(), roster.isWaitedFor(body)});
    }
  }

  void fillUnknown(bool isAnswered, EventsMessage& answer) const {
    answer.unknown.clear();
    for (const auto& [number, body] : roster.bodies()) {
      for (const UnknownSpan& span : body.unknown) {
        if (span.toUs <= answer.fromUs || span.fromUs >= answer.toUs) continue;
        answer.unknown.push_back({number, span.link, span.reason,
                                  std::max(span.fromUs, answer.fromUs),
                                  std::min(span.toUs, answer.toUs)});
      }
      const std::int64_t saidUs = body.saidUntilUs();
      if (body.slot || saidUs < 0 || saidUs >= answer.toUs) continue;
      answer.unknown.push_back(
          {number, kEveryLink, UndecidedReason::Gap, std::max(saidUs, answer.fromUs), answer.toUs});
    }
    if (isAnswered && answer.unknown.size() <= kMaxToldUnknown) return;
    const auto reason = isAnswered ? UndecidedReason::Gap : UndecidedReason::Resolution;
    answer.unknown.assign(1, {kEveryBody, kEveryLink, reason, answer.fromUs, answer.toUs});
    for (ToldEvent& event : answer.events) event.event.isAssumed = true;
  }
};

WorldSolver::WorldSolver(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorldSolver::WorldSolver(WorldSolver&&) noexcept = default;
WorldSolver& WorldSolver::operator=(WorldSolver&&) noexcept = default;
WorldSolver::~WorldSolver() = default;

Result<WorldSolver> WorldSolver::make(WorldSetup setup, const WorldPolicy& policy) {
  FORETOUCH_CHECK(checkedPolicy(policy));
  FORETOUCH_CHECK(checkedSetup(setup, policy));
  FORETOUCH_CHECK(internal::checkedSolids(setup));
  FORETOUCH_CHECK(LiveWorld::make(setup, false, 0));
  return WorldSolver(std::make_unique<Impl>(std::move(setup), policy));
}

Reject WorldSolver::take(const BodyMessage& message, std::int64_t receiveUtimeUs) {
  return impl_->roster.take(message, receiveUtimeUs);
}

Reject WorldSolver::take(const RigidPoseMessage& message, std::int64_t receiveUtimeUs) {
  return impl_->roster.take(message, receiveUtimeUs);
}

Reject WorldSolver::take(BodyNumber avatar, const StreamStep& step, std::int64_t receiveUtimeUs) {
  return impl_->roster.take(avatar, step, receiveUtimeUs);
}

void WorldSolver::changeSpeaker(BodyNumber body) {
  impl_->roster.changeSpeaker(body);
}

void WorldSolver::refusedState(Reject reason) {
  ++impl_->roster.counts().states;
  ++impl_->roster.counts().rejects[static_cast<std::size_t>(reason)];
}

void WorldSolver::refusedPose(BodyNumber body, Reject reason, std::int64_t receiveUtimeUs) {
  ++impl_->roster.counts().rigidPoses;
  static_cast<void>(impl_->roster.refusePose(body, reason, receiveUtimeUs));
}

bool WorldSolver::isNoted() const {
  return impl_->roster.isNoted();
}

const std::vector<Reject>& WorldSolver::reasons() const {
  return impl_->roster.reasons();
}

void WorldSolver::advance(std::vector<EventsMessage>& answers) {
  impl_->advance(answers);
}

bool WorldSolver::isThere(BodyNumber body) const {
  return impl_->roster.bodies().count(body) > 0;
}

std::vector<ShownBody>& WorldSolver::shown() {
  return impl_->shown;
}

bool WorldSolver::isSolid(BodyNumber body) const {
  return solidOptionsOf(impl_->setup, body) != nullptr;
}

std::size_t WorldSolver::numBodies() const {
  return impl_->roster.bodies().size();
}

bool WorldSolver::isAvatar(BodyNumber body) const {
  const auto found = impl_->roster.bodies().find(body);
  return found != impl_->roster.bodies().end() && found->second.isAvatar;
}

WorldCounts WorldSolver::counts() const {
  WorldCounts counts = impl_->roster.counts();
  counts.bodies = impl_->roster.bodies().size();
  counts.waitsFor = impl_->roster.waitsFor();
  counts.refusedLongest = impl_->roster.refusedBodies().list(counts.refusedBodies);
  counts.answeredUntilUs = impl_->world ? impl_->fromUs : -1;
  if (impl_->world) counts.failures += impl_->world->failures();
  for (const auto& [number, body] : impl_->roster.bodies()) counts.waiting += body.knots.size();
  return counts;
}

const WorldPolicy& WorldSolver::policy() const {
  return impl_->policy;
}

}  // namespace foretouch
