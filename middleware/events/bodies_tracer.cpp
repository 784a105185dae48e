#include "middleware/events/bodies_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// So much of a longer motion (us) is traced at once: with seconds, a live window would wait for
/// what only later ones say. Shorter, and people who are tracked 10 times per second are looked at
/// more than once per pose.
constexpr std::int64_t kMostMotionUs = 100'000;

/// As worldTimeAt(), rounded up: never earlier than it is.
WorldTime latestTimeAt(const SystemSpans& spans, double t) {
  const auto length = static_cast<double>(spans.endUs() - spans.beginUs());
  const double after = t > 0.0 ? std::nextafter(t * length, length) : 0.0;
  if (after >= length) return {spans.endUs(), 0.0};
  const double whole = std::floor(after);
  return {spans.beginUs() + static_cast<std::int64_t>(whole), after - whole};
}

WorldTime earliestTimeAt(const SystemSpans& spans, double t) {
  return worldTimeAt(spans.beginUs(), spans.endUs(), t);
}

/// The instant as a part of the span, rounded down; 0 before it, 1 at its end.
double partAt(const SystemSpans& spans, const WorldTime& time) {
  const auto length = static_cast<double>(spans.endUs() - spans.beginUs());
  const double part = microsecondsAfter(spans.beginUs(), time) / length;
  if (time == WorldTime{spans.endUs(), 0.0}) return 1.0;
  return part > 0.0 ? std::nextafter(part, 0.0) : 0.0;
}

}  // namespace

/// What one call is about.
struct BodiesTracer::Asked {
  const WorldParts& world;
  SystemPlans& plans;
  const BodyMasses& masses;
  const TraceWindow& window;
  const TracedBodies& bodies;
  TraceAnswer& answer;

  [[nodiscard]] FollowedBodies& followed() const { return *bodies.followed; }
  [[nodiscard]] std::vector<ListedPair>::const_iterator listed() const {
    return window.listed.begin() + static_cast<std::ptrdiff_t>(bodies.first);
  }
  /// In the window before.
  [[nodiscard]] bool wasAsked() const {
    const auto groupOf = [&](BodyId id) { return world.body(id).options.group; };
    const auto [a, b] = followed().bodies;
    if (b == kStillScene) return window.askedBefore.hasStill(groupOf(a));
    return a == b || window.askedBefore.has(groupOf(a), groupOf(b));
  }
  [[nodiscard]] PairKey keyOf(const FollowedSides& side) const {
    const BodyPair& both = followed().bodies;
    return {both.a, side.links.a, both.b, side.links.b, side.object};
  }
};

Result<Done> BodiesTracer::trace(const WorldParts& world, SystemPlans& plans,
                                 const BodyMasses& masses, const TraceWindow& window,
                                 const TracedBodies& bodies, TraceAnswer& answer) {
  const Asked asked{world, plans, masses, window, bodies, answer};
  if (bodies.isGivenUp()) {
    part_ = {};
    loseAll(asked, window.fromUs, UndecidedReason::WorkBudget);
    return Done{};
  }
  SpanSides span(world, plans, span_);
  const std::uint64_t looks = sides_.looks;
  sides_.work = 0;
  sides_.mostWork = bodies.work;
  const Result<Done> done = traceSpans(asked, span);
  answer.counters.pairs += sides_.looks - looks;
  return done;
}

Result<Done> BodiesTracer::traceSpans(const Asked& asked, SpanSides& span) {
  const TraceWindow& window = asked.window;
  part_ = {};  // not as the last bodies left it
  std::int64_t reachedUs = window.fromUs;
  if (!span.begin(asked.followed().bodies, window.fromUs, window.toUs)) {
    endAll(asked, reachedUs);
    return Done{};
  }
  SystemSpans& spans = span.spans();
  while (spans.next()) {
    part_ = {spans.beginUs(), spans.endUs(), isFresh(asked, spans), spans.isAssumed(),
             isChanged(spans)};
    // Their motion may show more than the part of it that was asked; but what is reported of the
    // two bodies as a whole holds for these links, too.
    if (part_.beginUs >= asked.bodies.lostUs) {
      loseAll(asked, part_.beginUs, UndecidedReason::Resolution);
      return Done{};
    }
    static_cast<void>(spans.widenToPieces(kMostMotionUs));
    enterMotion(asked, spans);
    FORETOUCH_TRY(const bool isResolved, traceSpan(asked, span));
    if (!isResolved) return Done{};
    reachedUs = part_.endUs;
  }
  if (reachedUs < window.toUs) loseAll(asked, reachedUs, UndecidedReason::Gap);
  return Done{};
}

/// Whether a contact that it has there may have begun before it was looked at.
bool BodiesTracer::isFresh(const Asked& asked, const SystemSpans& spans) {
  const TraceWindow& window = asked.window;
  const bool isBegin = spans.beginUs() == window.fromUs;
  if (isBegin && (window.isFirst || !asked.wasAsked())) return true;
  const BodyPair& both = asked.followed().bodies;
  const BodyPair asGivenUp{both.a, both.b == both.a ? kStillScene : both.b};
  const std::vector<BodyPair>& returned = window.returnedPairs;
  if (isBegin && std::binary_search(returned.begin(), returned.end(), asGivenUp)) return true;
  const auto& members = spans.members();
  return isChanged(spans) ||
         (isBegin && std::any_of(members.begin(), members.end(), [&](const SystemMember& member) {
            return std::binary_search(window.returned.begin(), window.returned.end(), member.body);
          }));
}

bool BodiesTracer::isChanged(const SystemSpans& spans) {
  const auto& members = spans.members();
  return std::any_of(members.begin(), members.end(), [&](const SystemMember& member) {
    return member.episode->beginUs == spans.beginUs();
  });
}

/// What is known of another motion says nothing about this one, but for what is open. What was free
/// before the window is so until it is listed.
void BodiesTracer::enterMotion(const Asked& asked, const SystemSpans& spans) {
  FollowedBodies& followed = asked.followed();
  const auto isOf = [](const SystemMember& member, const std::pair<BodyId, std::int64_t>& known) {
    return member.body == known.first && member.episode->beginUs == known.second;
  };
  const auto& now = spans.members();
  const auto& known = followed.members;
  if (followed.beginUs == spans.beginUs() && followed.endUs == spans.endUs() &&
      std::equal(now.begin(), now.end(), known.begin(), known.end(), isOf)) {
    return;
  }
  if (part_.beginUs == asked.window.fromUs) {
    auto& sides = followed.sides;
    sides.erase(std::remove_if(sides.begin(), sides.end(),
                               [](const FollowedSides& side) { return !side.isOpen; }),
                sides.end());
  }
  followed.forgetMotion();
  followed.beginUs = spans.beginUs();
  followed.endUs = spans.endUs();
  followed.members.clear();
  for (const SystemMember& member : now) {
    followed.members.emplace_back(member.body, member.episode->beginUs);
  }
}

/// False: doubles do not resolve where the bodies are, in the rest of the window.
Result<bool> BodiesTracer::traceSpan(const Asked& asked, SpanSides& span) {
  FollowedBodies& followed = asked.followed();
  if (part_.endUs < followed.nextUs && !isAnyNew(asked)) return true;
  sides_.work += kSpanWork;
  FORETOUCH_TRY(const SystemPlan* const plan, span.prepare());
  if (plan == nullptr) {
    endAll(asked, part_.beginUs);
    return true;
  }
  if (!span.isResolved()) {
    loseAll(asked, part_.beginUs, UndecidedReason::Resolution);
    return false;
  }
  addListed(asked, span);
  followed.nextUs = std::numeric_limits<std::int64_t>::max();
  for (FollowedSides& side : followed.sides) {
    if (!side.isTraced) traceSides(asked, span, side);
    tellParts(asked, span, side);
  }
  return true;
}

/// Whether it is listed in the span, and not followed on its motion.
bool BodiesTracer::isNew(const Asked& asked, const ListedPair& listed) const {
  const FollowedBodies& followed = asked.followed();
  if (!(listed.time < WorldTime{part_.endUs, 0.0})) return false;
  if (isOfObjects(asked.world, followed.bodies)) {
    return std::find(followed.collected.begin(), followed.collected.end(), listed.links) ==
           followed.collected.end();
  }
  return std::none_of(followed.sides.begin(), followed.sides.end(),
                      [&](const FollowedSides& side) { return side.links == listed.links; });
}

bool BodiesTracer::isAnyNew(const Asked& asked) const {
  const auto first = asked.listed();
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(asked.bodies.count),
                     [&](const ListedPair& listed) { return isNew(asked, listed); });
}

void BodiesTracer::addListed(const Asked& asked, SpanSides& span) {
  const auto first = asked.listed();
  for (auto listed = first; listed != first + static_cast<std::ptrdiff_t>(asked.bodies.count);
       ++listed) {
    if (!isNew(asked, *listed)) continue;
    const WorldTime from = std::max(listed->time, WorldTime{part_.beginUs, 0.0});
    if (isOfObjects(asked.world, asked.followed().bodies)) {
      addObjects(asked, span, listed->links, from);
    } else {
      add(asked, listed->links, kNoObject, from);
    }
  }
}

/// Adds the objects that the link may come near from there on.
void BodiesTracer::addObjects(const Asked& asked, SpanSides& span, const LinkPair& links,
                              const WorldTime& from) {
  FollowedBodies& followed = asked.followed();
  followed.collected.push_back(links);
  if (!span.set(links, sides_)) return;
  sides_.collect(partAt(span.spans(), from), 1.0, asked.world.options.tolerance, near_);
  for (const SidesPair& near : near_) {
    const ObjectId object = sides_.objectOf(near);
    const bool isKnown = std::any_of(
        followed.sides.begin(), followed.sides.end(),
        [&](const FollowedSides& side) { return side.links == links && side.object == object; });
    if (!isKnown) add(asked, links, object, from);
  }
}

void BodiesTracer::add(const Asked& asked, const LinkPair& links, ObjectId object,
                       const WorldTime& from) {
  FollowedSides side;
  side.links = links;
  side.object = object;
  side.from = from;
  asked.followed().sides.push_back(side);
}

bool BodiesTracer::set(const Asked& asked, SpanSides& span, const FollowedSides& side) {
  if (!span.set(side.links, sides_)) return false;
  if (isOfObjects(asked.world, asked.followed().bodies)) {
    sides_.setScene(sides_.scene(), side.object);
  }
  return true;
}

/// Traces from the span's begin, or from where it is listed, to the motion's end.
void BodiesTracer::traceSides(const Asked& asked, SpanSides& span, FollowedSides& side) {
  const WorldTime begin{part_.beginUs, 0.0};
  std::vector<StepPart>& parts = asked.followed().parts;
  side.isTraced = true;
  side.nextPart = side.endPart = parts.size();
  if (!set(asked, span, side)) return endOpen(asked, side, begin.us, LeaveCause::NotAsked);
  TraceStart start = TraceStart::Free;
  if (side.isOpen) {
    start = side.kind == PartKind::Contact ? TraceStart::Contact : TraceStart::Unknown;
  }
  const bool isFromBegin = side.isOpen || !(begin < side.from);
  const double from = partAt(span.spans(), isFromBegin ? begin : side.from);
  EventCounters& counters = asked.answer.counters;
  tracer_.trace(sides_, toleranceOf(asked, span), from, start, side.witness, parts, counters);
  side.endPart = parts.size();
  for (std::size_t i = side.nextPart; i < side.endPart; ++i) {
    counters.stretches += parts[i].kind == PartKind::Contact ? 1 : 0;
  }
  const bool beginsThere = side.isPending() && parts[side.nextPart].from == from;
  if (start == TraceStart::Unknown) {
    if (beginsThere && parts[side.nextPart].kind == PartKind::Unresolved) {
      side.nextPart = side.endPart;  // as before
      return;
    }
    end(asked, EventKind::UnresolvedTo, begin, side);
  }
  // What was in contact before does not begin anew; if it is over at once, it was torn apart.
  side.isMoved = part_.isChanged && start == TraceStart::Contact && beginsThere &&
                 !parts[side.nextPart].goesOn && parts[side.nextPart].to == from &&
                 !isNear(from, toleranceOf(asked, span).limit);
  side.startsInside =
      !side.isOpen && beginsThere && isFromBegin && (part_.isFresh || start == TraceStart::Unknown);
}

/// Whether the sides at hand are within `within` of each other.
bool BodiesTracer::isNear(double t, double within) {
  sides_.collect(t, t, within, near_);
  return std::any_of(near_.begin(), near_.end(), [&](const SidesPair& pair) {
    return sides_.at(pair, t).estimate() <= within;
  });
}

IntervalTolerance BodiesTracer::toleranceOf(const Asked& asked, const SpanSides& span) const {
  return IntervalTolerance::of(asked.world.options.tolerance, span.off());
}

/// Whether an event of the motion is reported in this part of it. What begins where it ends belongs
/// to the next one. The last part has whatever is left, however times are rounded.
bool BodiesTracer::isDue(const Asked& asked, const WorldTime& time, bool isEnd) const {
  FollowedBodies& followed = asked.followed();
  const WorldTime until{part_.endUs, 0.0};
  if (part_.endUs >= followed.endUs || (isEnd ? !(until < time) : time < until)) return true;
  followed.nextUs = std::min({followed.nextUs, time.us, followed.endUs});
  return false;
}

void BodiesTracer::tellParts(const Asked& asked, SpanSides& span, FollowedSides& side) {
  const std::vector<StepPart>& parts = asked.followed().parts;
  for (; side.isPending(); ++side.nextPart) {
    const StepPart& part = parts[side.nextPart];
    if (part.kind == PartKind::Contact) {
      if (!tellContact(asked, span, side)) break;
      continue;
    }
    const WorldTime time = beginAt(span, part);
    if (!isDue(asked, time, false)) break;
    begin(asked, EventKind::UnresolvedFrom, time, part.reason, side);
  }
  if (part_.isAssumed && side.isOpen && side.kind == PartKind::Contact) {
    asked.answer.assumed.push_back({asked.keyOf(side), {part_.endUs, 0.0}});
  }
}

/// Rounding leads to before the span only where it begins there.
WorldTime BodiesTracer::beginAt(SpanSides& span, const StepPart& part) const {
  return std::max(earliestTimeAt(span.spans(), part.from), WorldTime{part_.beginUs, 0.0});
}

/// Reports the side's next part. False: something of it is reported later.
bool BodiesTracer::tellContact(const Asked& asked, SpanSides& span, FollowedSides& side) {
  const std::vector<StepPart>& parts = asked.followed().parts;
  const StepPart& part = parts[side.nextPart];
  const double tolerance = asked.world.options.tolerance;
  if (!side.isOpen) {
    const WorldTime time = beginAt(span, part);
    if (!isDue(asked, time, false)) return false;
    ++asked.answer.counters.contacts;
    begin(asked, side.startsInside ? EventKind::StartsInside : EventKind::Enter, time,
          UndecidedReason::None, side);
    tellDetails(asked, span, side, part.from, tolerance);
    side.startsInside = false;
  }
  const bool isLost = side.nextPart + 1 < side.endPart &&
                      parts[side.nextPart + 1].kind == PartKind::Unresolved &&
                      parts[side.nextPart + 1].from == part.to;
  if (part.goesOn || isLost) return true;
  WorldTime time = std::max(latestTimeAt(span.spans(), part.to), WorldTime{part_.beginUs, 0.0});
  if (!(side.since < time)) time = justAfter(side.since);
  if (!isDue(asked, time, true)) return false;
  if (std::exchange(side.isMoved, false)) {
    endOpen(asked, side, part_.beginUs, LeaveCause::Moved);
    return true;
  }
  end(asked, EventKind::Leave, time, side);
  tellDetails(asked, span, side, part.to, toleranceOf(asked, span).limit);
  return true;
}

/// Adds the details of the event that was reported last.
void BodiesTracer::tellDetails(const Asked& asked, SpanSides& span, const FollowedSides& side,
                               double t, double within) {
  if (!set(asked, span, side)) return;
  details_.fill(span, sides_, t, within, asked.masses, asked.answer.events.back());
}

/// Ends what ends there although nothing moves apart.
void BodiesTracer::endOpen(const Asked& asked, FollowedSides& side, std::int64_t utimeUs,
                           LeaveCause cause) {
  if (!side.isOpen) return;
  const bool isContact = side.kind == PartKind::Contact;
  end(asked, isContact ? EventKind::Leave : EventKind::UnresolvedTo, {utimeUs, 0.0}, side);
  if (!isContact) return;
  asked.answer.events.back().cause = cause;
  tellLast(asked, side, utimeUs);
}

/// Adds the details of the last event where the motion before ends. Nothing, where that is unknown.
void BodiesTracer::tellLast(const Asked& asked, const FollowedSides& side, std::int64_t utimeUs) {
  SpanSides before(asked.world, asked.plans, spanBefore_);
  // They need not be asked any more.
  static_cast<void>(before.begin(asked.followed().bodies, utimeUs - 1, utimeUs));
  SystemSpans& spans = before.spans();
  if (!spans.next()) return;
  static_cast<void>(spans.widenToPieces(kMostMotionUs));
  const auto plan = before.prepare();
  if (!plan.ok() || plan.value() == nullptr || !before.set(side.links, sidesBefore_)) return;
  if (isOfObjects(asked.world, asked.followed().bodies)) {
    sidesBefore_.setScene(sidesBefore_.scene(), side.object);
  }
  const double t = partAt(spans, {utimeUs, 0.0});
  details_.fill(before, sidesBefore_, t, toleranceOf(asked, before).limit, asked.masses,
                asked.answer.events.back());
}

/// Ends all: nothing of the two is asked from there on.
void BodiesTracer::endAll(const Asked& asked, std::int64_t utimeUs) {
  FollowedBodies& followed = asked.followed();
  for (FollowedSides& side : followed.sides) {
    endOpen(asked, side, utimeUs, LeaveCause::NotAsked);
  }
  followed.clear();
}

/// Loses all: nothing is claimed of them from there on.
void BodiesTracer::loseAll(const Asked& asked, std::int64_t utimeUs, UndecidedReason reason) {
  FollowedBodies& followed = asked.followed();
  for (FollowedSides& side : followed.sides) {
    if (!side.isOpen || side.kind == PartKind::Unresolved) continue;
    begin(asked, EventKind::UnresolvedFrom, {utimeUs, 0.0}, reason, side);
  }
  followed.forgetMotion();
}

void BodiesTracer::begin(const Asked& asked, EventKind kind, const WorldTime& time,
                         UndecidedReason reason, FollowedSides& side) {
  const bool isUnresolved = kind == EventKind::UnresolvedFrom;
  side.isOpen = true;
  side.kind = isUnresolved ? PartKind::Unresolved : PartKind::Contact;
  side.reason = reason;
  side.since = time;
  tell(asked, kind, time, side);
}

void BodiesTracer::end(const Asked& asked, EventKind kind, const WorldTime& time,
                       FollowedSides& side) {
  tell(asked, kind, time, side);
  side.isOpen = false;
}

void BodiesTracer::tell(const Asked& asked, EventKind kind, const WorldTime& time,
                        const FollowedSides& side) {
  const BodyPair& bodies = asked.followed().bodies;
  asked.answer.events.emplace_back();
  WorldEvent& event = asked.answer.events.back();
  event.kind = kind;
  event.reason = side.reason;
  event.isAssumed = part_.isAssumed;
  event.time = time;
  event.since = side.since;
  event.a.body = bodies.a;
  event.a.link = side.links.a;
  event.b.body = bodies.b;
  event.b.link = side.links.b;
  event.object = side.object;
  event.effectiveMass = std::numeric_limits<double>::infinity();
}

}  // namespace foretouch::internal
