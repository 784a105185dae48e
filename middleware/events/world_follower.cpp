#include "middleware/events/world_follower.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/events/bodies_tracer.h"
#include "middleware/events/followed_list.h"
#include "middleware/events/open_parts.h"
#include "middleware/events/span_sides.h"
#include "middleware/worker_pool.h"
#include "middleware/world/window_query.h"

namespace foretouch {

using internal::AssumedContact;
using internal::BodiesTracer;
using internal::BodyMasses;
using internal::ListedPair;
using internal::OpenParts;
using internal::PairKey;
using internal::TraceAnswer;
using internal::TracedBodies;
using internal::TraceWindow;
using internal::WorldParts;

namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// The first pose of any body, or change of a body's carrier, after the instant.
std::int64_t nextCutUs(const WorldParts& world, std::int64_t afterUs) {
  std::int64_t next = kNever;
  for (const internal::WorldBody& body : world.bodies) {
    next = std::min(next, body.nextEpisodeUs(afterUs));
    const internal::Episode* const episode = body.episodeAt(afterUs);
    if (episode != nullptr) next = std::min(next, episode->track.nextKnotUs(afterUs));
  }
  return next;
}

/// How far the instant is beyond the last multiple of `step`: in [0, step).
std::int64_t beyondMultiple(std::int64_t us, std::int64_t step) {
  const std::int64_t rest = us % step;
  return rest < 0 ? rest + step : rest;
}

/// The multiple of `step` at or before the instant; the earliest instant if there is none.
std::int64_t multipleBefore(std::int64_t us, std::int64_t step) {
  const std::int64_t rest = beyondMultiple(us, step);
  return us < std::numeric_limits<std::int64_t>::min() + rest
             ? std::numeric_limits<std::int64_t>::min()
             : us - rest;
}

/// The first multiple after the instant; never, if there is none.
std::int64_t multipleAfter(std::int64_t us, std::int64_t step) {
  const std::int64_t rest = step - beyondMultiple(us, step);
  return us > kNever - rest ? kNever : us + rest;
}

PairKey keyOf(const WorldContact& contact) {
  return internal::keyOf(contact, internal::kNoObject);
}

/// Two whole bodies of which nothing is known from an instant on.
struct GivenUp {
  PairKey key;
  WorldTime time;
  UndecidedReason reason = UndecidedReason::None;
};

/// One thread's memory, and its part of a window's events.
struct alignas(128) Worker {
  BodiesTracer tracer;
  TraceAnswer answer;
  internal::FirstFailure failure{"window"};
};

}  // namespace

struct WorldFollower::Impl {
  FollowOptions options;
  std::optional<WorkerPool> pool;
  std::int64_t startUs = 0, untilUs = 0;
  std::uint64_t world = 0;  // the one that it follows; 0: none yet
  BodyMasses masses;
  std::optional<internal::WorldMemory> scratch{std::in_place};
  WorldContacts contacts;
  OpenParts open, openBefore;                // the latter: as it was before the call
  internal::GroupsAsked asked, askedBefore;  // in the last window; as openBefore
  internal::FollowedList followed;           // all that is open, and more about it
  bool isFollowedLost = false;               // a call has failed: only what is open is known
  internal::FollowedLinks known;
  TraceWindow window;
  std::vector<TracedBodies> tasks;
  internal::WorkShares shares;                 // for the tasks
  std::vector<GivenUp> givenUp;                // in the window, by pair
  std::vector<BodyId> unknown, unknownBefore;  // silent and undecided, by number; as openBefore
  bool isSaved = false;                        // what was before the call
  std::vector<std::unique_ptr<Worker>> workers;
  std::vector<WorldEvent> own;  // about whole bodies
  std::vector<const WorldEvent*> order;
  std::vector<AssumedContact> assumed;

  [[nodiscard]] std::int64_t endOf(std::int64_t wantedUs) const {
    return options.cutUs > 0 ? multipleBefore(wantedUs, options.cutUs) : wantedUs;
  }
  [[nodiscard]] Result<Done> checkedCuts(std::int64_t endUs) const {
    if (options.cutUs == 0 || endUs <= untilUs) return Done{};
    // Ages may be longer than their type holds.
    const std::uint64_t length =
        static_cast<std::uint64_t>(endUs) - static_cast<std::uint64_t>(untilUs);
    if (length / static_cast<std::uint64_t>(options.cutUs) <= kMostCuts) return Done{};
    return Error::in("untilUs", ErrorCode::OutOfRange,
                     "expected at most " + std::to_string(kMostCuts) + " cuts of " +
                         std::to_string(options.cutUs) + " us in one call, found " +
                         std::to_string(untilUs) + " to " + std::to_string(endUs) + " us");
  }
  [[nodiscard]] std::int64_t nextUs(const WorldParts& parts, std::int64_t endUs,
                                    std::uint64_t numWindows) const {
    if (numWindows >= options.mostWindows) return endUs;
    const std::int64_t next =
        options.cutUs > 0 ? multipleAfter(untilUs, options.cutUs) : nextCutUs(parts, untilUs);
    return std::min(next, endUs);
  }

  Result<Done> followTo(const World& of, std::int64_t endUs, WorldEvents& answer) {
    open.beginTime(untilUs);
    while (untilUs < endUs) {
      const std::int64_t toUs = nextUs(of.parts(), endUs, answer.counters.windows + 1);
      if (std::exchange(isFollowedLost, false)) followed.assign(open.all());
      followed.tellKnown(of.parts(), untilUs, toUs, known);
      FORETOUCH_CHECK(
          askWindow(of, untilUs, toUs, pool ? &*pool : nullptr, *scratch, contacts, &known));
      internal::addCounters(contacts.counters, answer.world);
      ++answer.counters.windows;
      FORETOUCH_CHECK(traceWindow(of.parts(), toUs));
      takeEvents(answer);
      asked = of.parts().groups;
      untilUs = toUs;
    }
    open.endTime(endUs, answer.parts);
    // Where windows meet, what ends in the one may come after what begins in the other.
    std::vector<WorldEvent>& events = answer.events;
    if (!std::is_sorted(events.begin(), events.end(), comesBefore)) {
      std::sort(events.begin(), events.end(), comesBefore);
    }
    return Done{};
  }

  /// As followTo(), but memory that runs out is an error like others.
  Result<Done> attempt(const World& of, std::int64_t endUs, WorldEvents& answer) {
    isSaved = false;
    try {
      openBefore = open;
      unknownBefore = unknown;
      askedBefore = asked;
      isSaved = true;
      FORETOUCH_CHECK(followTo(of, endUs, answer));
      answer.silent = contacts.silent;
      return Done{};
    } catch (const std::exception& broken) {
      scratch.emplace();  // may be half written, and so may these
      for (const auto& worker : workers) *worker = Worker();
      return internal::brokenOff("window", broken);
    }
  }

  /// As if the call had not been.
  void takeBack(std::int64_t fromUs) {
    untilUs = fromUs;
    if (!isSaved) return;
    std::swap(open, openBefore);
    std::swap(unknown, unknownBefore);
    asked = askedBefore;
    isFollowedLost = true;
  }

  Result<Done> traceWindow(const WorldParts& parts, std::int64_t toUs) {
    window.fromUs = untilUs;
    window.toUs = toUs;
    window.isFirst = untilUs == startUs;
    window.askedBefore = asked;
    own.clear();
    listPairs();
    followed.plan(window.fromUs, window.listed, tasks);
    shareTasks(parts);
    listGivenUp();
    tellUnknown();
    for (const auto& worker : workers) {
      worker->answer.clear();
      worker->failure.clear();
    }
    return traceAll(parts);
  }

  /// Reports bodies of which nothing is known, or is known again, and pairs that are given up.
  void tellUnknown() {
    window.returned.clear();
    window.returnedPairs.clear();
    const auto isNow = [this](BodyId body) {
      return std::any_of(contacts.silent.begin(), contacts.silent.end(), [&](const SilentBody& s) {
        return s.body == body && s.takenTo == WhenSilent::Undecided && s.sinceUs == window.fromUs;
      });
    };
    for (const BodyId body : unknown) {
      if (isNow(body)) continue;
      window.returned.push_back(body);
    }
    for (const OpenPart& part : open.all()) {
      const PairKey key = internal::keyOf(part, part.object);
      if (!isOfEveryLink(key)) continue;
      const bool goesOn = key.bodyOfB == kEveryBody ? isNow(key.bodyOfA) : isGivenUp(key);
      if (goesOn) continue;
      tellOwn(EventKind::UnresolvedTo, key, {window.fromUs, 0.0}, part.since, part.reason);
      if (key.bodyOfB != kEveryBody) window.returnedPairs.push_back({key.bodyOfA, key.bodyOfB});
    }
    unknown.clear();
    for (const SilentBody& silent : contacts.silent) {
      if (silent.takenTo != WhenSilent::Undecided) continue;
      unknown.push_back(silent.body);
      const PairKey key{silent.body, kEveryLink, kEveryBody, kEveryLink, internal::kNoObject};
      tellNew(key, {silent.sinceUs, 0.0}, silent.reason);
    }
    for (const GivenUp& pair : givenUp) tellNew(pair.key, pair.time, pair.reason);
  }

  /// Whether both are crowded: each is reported as a body of which nothing is known.
  [[nodiscard]] bool areCrowded(const TracedBodies& task) const {
    const std::vector<bool>& isCrowded = scratch->isCrowded;
    const auto [a, b] = task.followed->bodies;
    return !isCrowded.empty() && a != b && b >= 0 && isCrowded[slotOf(a)] && isCrowded[slotOf(b)];
  }

  /// Shares what each two may cost while they are followed, as while they are asked.
  void shareTasks(const WorldParts& parts) {
    shares.begin(parts.bodies.size());
    for (const TracedBodies& task : tasks) {
      shares.add(task.followed->bodies.a, task.followed->bodies.b);
    }
    shares.share(parts.options.workPerWindow, parts.options.workPerPair);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      tasks[i].work = areCrowded(tasks[i]) ? 0 : shares.of(i);
    }
  }

  /// The key of the two as a whole; a body's line about the scene is also about its own links.
  [[nodiscard]] static PairKey wholeKeyOf(const TracedBodies& task) {
    const internal::BodyPair& both = task.followed->bodies;
    const BodyId with = both.b == both.a ? kStillScene : both.b;
    return {both.a, kEveryLink, with, kEveryLink, internal::kNoObject};
  }

  void listGivenUp() {
    givenUp.clear();
    for (const WorldContact& contact : contacts.contacts) {
      const PairKey key = keyOf(contact);
      if (isOfEveryLink(key)) givenUp.push_back({key, contact.time, contact.reason});
    }
    for (const TracedBodies& task : tasks) {
      if (!task.isGivenUp() || areCrowded(task)) continue;
      givenUp.push_back({wholeKeyOf(task), {window.fromUs, 0.0}, UndecidedReason::WorkBudget});
    }
    std::sort(givenUp.begin(), givenUp.end(), [](const GivenUp& x, const GivenUp& y) {
      return x.key == y.key ? x.time < y.time : x.key < y.key;
    });
    const auto isSame = [](const GivenUp& x, const GivenUp& y) { return x.key == y.key; };
    givenUp.erase(std::unique(givenUp.begin(), givenUp.end(), isSame), givenUp.end());
    for (TracedBodies& task : tasks) {
      const GivenUp* const whole = findGivenUp(wholeKeyOf(task));
      if (whole && whole->reason == UndecidedReason::Resolution) task.lostUs = whole->time.us;
    }
  }

  /// Whether the window begins with the two unknown.
  [[nodiscard]] bool isGivenUp(const PairKey& key) const {
    const GivenUp* const found = findGivenUp(key);
    return found && found->time == WorldTime{window.fromUs, 0.0};
  }

  [[nodiscard]] const GivenUp* findGivenUp(const PairKey& key) const {
    const auto found = std::lower_bound(
        givenUp.begin(), givenUp.end(), key,
        [](const GivenUp& pair, const PairKey& wanted) { return pair.key < wanted; });
    return found != givenUp.end() && found->key == key ? &*found : nullptr;
  }

  void tellNew(const PairKey& key, const WorldTime& time, UndecidedReason reason) {
    const bool isKnown = open.has(key) && time == WorldTime{window.fromUs, 0.0};
    if (!isKnown) tellOwn(EventKind::UnresolvedFrom, key, time, time, reason);
  }

  void tellOwn(EventKind kind, const PairKey& key, const WorldTime& time, const WorldTime& since,
               UndecidedReason reason) {
    WorldEvent event;
    event.kind = kind;
    event.reason = reason;
    event.time = time;
    event.since = since;
    event.a.body = key.bodyOfA;
    event.a.link = key.linkOfA;
    event.b.body = key.bodyOfB;
    event.b.link = key.linkOfB;
    event.effectiveMass = std::numeric_limits<double>::infinity();
    own.push_back(event);
  }

  /// Links that may come near each other in the window.
  void listPairs() {
    std::vector<ListedPair>& listed = window.listed;
    listed.clear();
    for (const WorldContact& contact : contacts.contacts) {
      const PairKey key = keyOf(contact);
      if (isOfEveryLink(key)) continue;
      listed.push_back({{key.bodyOfA, key.bodyOfB}, {key.linkOfA, key.linkOfB}, contact.time});
    }
    std::sort(listed.begin(), listed.end(), [](const ListedPair& x, const ListedPair& y) {
      return x.bodies == y.bodies ? x.links < y.links : x.bodies < y.bodies;
    });
  }

  Result<Done> traceAll(const WorldParts& parts) {
    std::atomic<std::size_t> next{0};
    const auto takePart = [&](std::size_t number) {
      Worker& worker = *workers[number];
      for (std::size_t i = next.fetch_add(1); i < tasks.size(); i = next.fetch_add(1)) {
        worker.failure.attempt(
            i,
            [&] {
              return worker.tracer.trace(parts, scratch->plans, masses, window, tasks[i],
                                         worker.answer);
            },
            [&] { worker.tracer = BodiesTracer(); });
      }
    };
    if (pool && tasks.size() > 1) {
      pool->run(std::ref(takePart));
    } else {
      takePart(0);
    }
    return internal::FirstFailure::of(
        workers.size(), [&](std::size_t i) -> const auto& { return workers[i]->failure; });
  }

  void takeEvents(WorldEvents& answer) {
    order.clear();
    assumed.clear();
    for (const WorldEvent& event : own) order.push_back(&event);
    for (const auto& worker : workers) {
      const TraceAnswer& traced = worker->answer;
      for (const WorldEvent& event : traced.events) order.push_back(&event);
      assumed.insert(assumed.end(), traced.assumed.begin(), traced.assumed.end());
      answer.counters.add(traced.counters);
    }
    std::sort(order.begin(), order.end(),
              [](const WorldEvent* x, const WorldEvent* y) { return comesBefore(*x, *y); });
    std::sort(assumed.begin(), assumed.end(),
              [](const AssumedContact& x, const AssumedContact& y) { return x.time < y.time; });
    auto next = assumed.begin();
    for (const WorldEvent* const event : order) {
      // Before the event: it may end what goes on until there.
      for (; next != assumed.end() && !(event->time < next->time); ++next) open.assume(next->pair);
      open.take(*event, answer.parts);
      answer.events.push_back(*event);
    }
    for (; next != assumed.end(); ++next) open.assume(next->pair);
  }
};

WorldFollower::WorldFollower(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
WorldFollower::~WorldFollower() = default;
WorldFollower::WorldFollower(WorldFollower&&) noexcept = default;
WorldFollower& WorldFollower::operator=(WorldFollower&&) noexcept = default;

Result<WorldFollower> WorldFollower::start(std::int64_t fromUs, const FollowOptions& options) {
  if (fromUs < -kMostUtimeUs || fromUs > kMostUtimeUs) {
    return Error::in("from", ErrorCode::OutOfRange,
                     "expected an instant within 2^53 us of 0, found " + std::to_string(fromUs));
  }
  if (options.cutUs < 0 || options.cutUs > kMostCutUs) {
    return Error::in("cutUs", ErrorCode::OutOfRange,
                     "expected 0 to " + std::to_string(kMostCutUs) + " us, found " +
                         std::to_string(options.cutUs));
  }
  auto impl = std::make_unique<Impl>();
  impl->options = options;
  impl->startUs = impl->untilUs = fromUs;
  if (options.threads != 1) {
    FORETOUCH_TRY(impl->pool, WorkerPool::start(options.threads));
  }
  const int count = impl->pool ? impl->pool->threads() : 1;
  for (int i = 0; i < count; ++i) impl->workers.push_back(std::make_unique<Worker>());
  return WorldFollower(std::move(impl));
}

Result<Done> WorldFollower::weigh(BodyId body, const Mass& mass) {
  if (body < 0) return Error::at(body, ErrorCode::OutOfRange, "expected a body, found one below 0");
  FORETOUCH_TRY(const Mass known, checkedMass(mass));
  impl_->masses.set(body, known);
  return Done{};
}

Result<Done> WorldFollower::weigh(BodyId body, AvatarMass mass) {
  if (body < 0) return Error::at(body, ErrorCode::OutOfRange, "expected a body, found one below 0");
  impl_->masses.set(body, std::move(mass));
  return Done{};
}

Result<Done> WorldFollower::follow(const World& world, std::int64_t untilUs, WorldEvents& answer) {
  Impl& impl = *impl_;
  const WorldParts& parts = world.parts();
  if (impl.world != 0 && impl.world != parts.identity) {
    return Error::in("world", ErrorCode::Mismatch, "expected the world that it has followed");
  }
  FORETOUCH_CHECK(impl.masses.checked(parts));
  FORETOUCH_CHECK(internal::checkedSides(parts));
  const std::int64_t endUs = impl.endOf(untilUs), fromUs = impl.untilUs;
  if (endUs > fromUs) {
    FORETOUCH_CHECK(internal::checkedWindow(world, fromUs, endUs));
    FORETOUCH_CHECK(impl.checkedCuts(endUs));
  }
  impl.world = parts.identity;
  answer.fromUs = fromUs;
  answer.toUs = std::max(fromUs, endUs);
  answer.events.clear();
  answer.parts.clear();
  answer.silent.clear();
  answer.world = {};
  answer.counters = {};
  if (endUs <= fromUs) return Done{};
  const Result<Done> done = impl.attempt(world, endUs, answer);
  if (!done.ok()) {
    impl.takeBack(fromUs);
    answer.toUs = fromUs;
    answer.events.clear();
    answer.parts.clear();
  }
  return done;
}

std::int64_t WorldFollower::followedUntilUs() const {
  return impl_->untilUs;
}

const std::vector<OpenPart>& WorldFollower::open() const {
  return impl_->open.all();
}

}  // namespace foretouch
