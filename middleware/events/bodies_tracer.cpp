#include "middleware/events/bodies_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

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

/// The instant as a part of the span, rounded down; 0 before it.
double partAt(const SystemSpans& spans, const WorldTime& time) {
  const auto length = static_cast<double>(spans.endUs() - spans.beginUs());
  const double part = microsecondsAfter(spans.beginUs(), time) / length;
  return part > 0.0 ? std::nextafter(part, 0.0) : 0.0;
}

}  // namespace

/// What one call is about.
struct BodiesTracer::Asked {
  const WorldParts& world;
  const BodyMasses& masses;
  const TraceWindow& window;
  const TracedBodies& bodies;
  TraceAnswer& answer;

  [[nodiscard]] const TracedPair& pair(std::size_t i) const {
    return window.pairs[bodies.first + i];
  }
  [[nodiscard]] PairKey keyOf(const Following& followed) const {
    const LinkPair& links = pair(followed.pair).links;
    return {bodies.bodies.a, links.a, bodies.bodies.b, links.b, followed.object};
  }
};

Result<Done> BodiesTracer::trace(const WorldParts& world, SystemPlans& plans,
                                 const BodyMasses& masses, const TraceWindow& window,
                                 const TracedBodies& bodies, TraceAnswer& answer) {
  const Asked asked{world, masses, window, bodies, answer};
  isAssumed_ = isFresh_ = false;  // not as the last bodies left them
  beginFollowing(asked);
  SpanSides span(world, plans, system_);
  const std::uint64_t looks = sides_.looks;
  const Result<Done> done = traceSpans(asked, span);
  answer.counters.pairs += sides_.looks - looks;
  return done;
}

Result<Done> BodiesTracer::traceSpans(const Asked& asked, SpanSides& span) {
  const TraceWindow& window = asked.window;
  const TracedBodies& bodies = asked.bodies;
  WorldTime reached{window.fromUs, 0.0};
  if (!span.begin(bodies.bodies, window.fromUs, window.toUs)) {
    for (std::size_t i = 0; i < bodies.count; ++i) {
      endOpen(asked, i, reached, LeaveCause::NotAsked);
    }
    return Done{};
  }
  SystemSpans& spans = span.spans();
  while (spans.next()) {
    reached = {spans.beginUs(), 0.0};
    FORETOUCH_TRY(const SystemPlan* const plan, span.prepare());
    isAssumed_ = spans.isAssumed();
    isFresh_ = isFresh(window, spans);
    if (plan == nullptr) {
      for (std::size_t i = 0; i < bodies.count; ++i) {
        endOpen(asked, i, reached, LeaveCause::NotAsked);
      }
    } else if (!span.isResolved()) {
      loseOpen(asked, reached, UndecidedReason::Resolution);
      return Done{};
    } else {
      traceSpan(asked, span);
    }
    reached = {spans.endUs(), 0.0};
  }
  if (reached.us < window.toUs) loseOpen(asked, reached, UndecidedReason::Gap);
  return Done{};
}

void BodiesTracer::beginFollowing(const Asked& asked) {
  following_.clear();
  for (std::size_t i = 0; i < asked.bodies.count; ++i) {
    const TracedPair& pair = asked.pair(i);
    for (std::size_t k = 0; k < pair.numOpen; ++k) {
      const OpenPart& open = (*asked.window.open)[pair.firstOpen + k];
      following_.push_back(
          {i, open.object, {asked.window.fromUs, 0.0}, true, open.kind, open.reason, open.since});
    }
    const bool isOfLinks = asked.bodies.bodies.b != kStillScene &&
                           asked.world.kindOf(asked.bodies.bodies.a).avatar &&
                           asked.world.kindOf(asked.bodies.bodies.b).avatar;
    if (isOfLinks && pair.isListed && pair.numOpen == 0) {
      following_.push_back(
          {i, kNoObject, pair.listed, false, PartKind::Contact, UndecidedReason::None, {}});
    }
  }
}

/// What it is in contact with there may have begun before anybody looked.
bool BodiesTracer::isFresh(const TraceWindow& window, const SystemSpans& spans) {
  const bool isBegin = spans.beginUs() == window.fromUs;
  if (isBegin && window.isFirst) return true;
  const auto& members = spans.members();
  return std::any_of(members.begin(), members.end(), [&](const SystemMember& member) {
    if (member.episode->beginUs == spans.beginUs()) return true;
    return isBegin &&
           std::binary_search(window.returned.begin(), window.returned.end(), member.body);
  });
}

void BodiesTracer::traceSpan(const Asked& asked, SpanSides& span) {
  for (std::size_t i = 0; i < asked.bodies.count; ++i) {
    if (span.set(asked.pair(i).links, sides_)) {
      tracePair(asked, span, i);
    } else {
      endOpen(asked, i, {span.spans().beginUs(), 0.0}, LeaveCause::NotAsked);
    }
  }
}

void BodiesTracer::tracePair(const Asked& asked, SpanSides& span, std::size_t pair) {
  if (sides_.isScene()) addObjects(asked, span, pair);
  for (std::size_t k = 0; k < following_.size(); ++k) {
    if (following_[k].pair == pair) traceOne(asked, span, following_[k]);
  }
}

/// Those that the link may come near from where it first does.
void BodiesTracer::addObjects(const Asked& asked, SpanSides& span, std::size_t pair) {
  const TracedPair& traced = asked.pair(pair);
  if (!traced.isListed || !(traced.listed < WorldTime{span.spans().endUs(), 0.0})) return;
  const WorldTime from = std::max(traced.listed, WorldTime{span.spans().beginUs(), 0.0});
  sides_.collect(partAt(span.spans(), from), 1.0, asked.world.options.tolerance, near_);
  for (const SidesPair& near : near_) {
    const ObjectId object = sides_.objectOf(near);
    const bool isKnown =
        std::any_of(following_.begin(), following_.end(), [&](const Following& followed) {
          return followed.pair == pair && followed.object == object;
        });
    if (isKnown) continue;
    following_.push_back({pair, object, from, false, PartKind::Contact, UndecidedReason::None, {}});
  }
}

void BodiesTracer::traceOne(const Asked& asked, SpanSides& span, Following& followed) {
  const SystemSpans& spans = span.spans();
  if (!(followed.from < WorldTime{spans.endUs(), 0.0})) return;
  if (sides_.isScene()) sides_.setScene(sides_.scene(), followed.object);
  TraceStart start = TraceStart::Free;
  if (followed.isOpen) {
    start = followed.kind == PartKind::Contact ? TraceStart::Contact : TraceStart::Unknown;
  }
  const IntervalTolerance tolerance =
      IntervalTolerance::of(asked.world.options.tolerance, span.off());
  parts_.clear();
  const double from = followed.isOpen ? 0.0 : partAt(spans, followed.from);
  tracer_.trace(sides_, tolerance, from, start, parts_, asked.answer.counters);
  const bool wasUnknown = start == TraceStart::Unknown;
  const bool isStillUnknown = wasUnknown && !parts_.empty() &&
                              parts_.front().kind == PartKind::Unresolved &&
                              parts_.front().from == 0.0;
  if (isStillUnknown) return;
  if (wasUnknown) end(asked, EventKind::UnresolvedTo, {spans.beginUs(), 0.0}, followed);
  takeParts(asked, span, wasUnknown, followed);
}

void BodiesTracer::takeParts(const Asked& asked, SpanSides& span, bool wasUnknown,
                             Following& followed) {
  const SystemSpans& spans = span.spans();
  const IntervalTolerance tolerance =
      IntervalTolerance::of(asked.world.options.tolerance, span.off());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const StepPart& part = parts_[i];
    if (part.kind == PartKind::Unresolved) {
      begin(asked, EventKind::UnresolvedFrom, earliestTimeAt(spans, part.from),
            UndecidedReason::Resolution, followed);
      continue;
    }
    ++asked.answer.counters.stretches;
    const bool goesOnFromBefore = i == 0 && followed.isOpen;
    if (!goesOnFromBefore) {
      const bool isInside = part.from == 0.0 && (isFresh_ || wasUnknown);
      ++asked.answer.counters.contacts;
      begin(asked, isInside ? EventKind::StartsInside : EventKind::Enter,
            earliestTimeAt(spans, part.from), UndecidedReason::None, followed);
      details_.fill(span, sides_, part.from, asked.world.options.tolerance, asked.masses,
                    asked.answer.events.back());
    }
    const bool isLost = i + 1 < parts_.size() && parts_[i + 1].kind == PartKind::Unresolved &&
                        parts_[i + 1].from == part.to;
    if (part.goesOn && isAssumed_) {
      asked.answer.assumed.push_back({asked.keyOf(followed), {spans.endUs(), 0.0}});
    }
    if (part.goesOn || isLost) continue;
    WorldTime time = latestTimeAt(spans, part.to);
    if (!(followed.since < time)) {
      time = {followed.since.us, std::nextafter(followed.since.fraction, 1.0)};
    }
    end(asked, EventKind::Leave, time, followed);
    details_.fill(span, sides_, part.to, tolerance.limit, asked.masses, asked.answer.events.back());
  }
  if (!followed.isOpen) followed.from = {spans.endUs(), 0.0};
}

void BodiesTracer::endOpen(const Asked& asked, std::size_t pair, const WorldTime& time,
                           LeaveCause cause) {
  for (Following& followed : following_) {
    if (followed.pair != pair) continue;
    if (followed.isOpen && followed.kind == PartKind::Unresolved) {
      end(asked, EventKind::UnresolvedTo, time, followed);
    } else if (followed.isOpen) {
      end(asked, EventKind::Leave, time, followed);
      asked.answer.events.back().cause = cause;
    }
    followed.from = std::max(followed.from, time);
  }
}

void BodiesTracer::loseOpen(const Asked& asked, const WorldTime& time, UndecidedReason reason) {
  for (Following& followed : following_) {
    if (!followed.isOpen || followed.kind == PartKind::Unresolved) continue;
    begin(asked, EventKind::UnresolvedFrom, time, reason, followed);
  }
}

void BodiesTracer::begin(const Asked& asked, EventKind kind, const WorldTime& time,
                         UndecidedReason reason, Following& followed) {
  const bool isUnresolved = kind == EventKind::UnresolvedFrom;
  followed.isOpen = true;
  followed.kind = isUnresolved ? PartKind::Unresolved : PartKind::Contact;
  followed.reason = reason;
  followed.since = time;
  tell(asked, kind, time, followed);
}

void BodiesTracer::end(const Asked& asked, EventKind kind, const WorldTime& time,
                       Following& followed) {
  tell(asked, kind, time, followed);
  followed.isOpen = false;
}

WorldEvent& BodiesTracer::tell(const Asked& asked, EventKind kind, const WorldTime& time,
                               const Following& followed) {
  const LinkPair& links = asked.pair(followed.pair).links;
  asked.answer.events.emplace_back();
  WorldEvent& event = asked.answer.events.back();
  event.kind = kind;
  event.reason = followed.reason;
  event.isAssumed = isAssumed_;
  event.time = time;
  event.since = followed.since;
  event.a.body = asked.bodies.bodies.a;
  event.a.link = links.a;
  event.b.body = asked.bodies.bodies.b;
  event.b.link = links.b;
  event.object = followed.object;
  event.effectiveMass = std::numeric_limits<double>::infinity();
  return event;
}

}  // namespace foretouch::internal
