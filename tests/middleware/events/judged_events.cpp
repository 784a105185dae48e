#include "tests/middleware/events/judged_events.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "middleware/world/world_parts.h"

namespace foretouch::test {
namespace {

constexpr std::size_t kMostProblems = 20;
/// What long doubles and doubles may differ by (m).
constexpr Real kPlaces = 1e-9L;

}  // namespace

void EventTally::add(const EventTally& more) {
  samples += more.samples;
  touching += more.touching;
  inContact += more.inContact;
  missed += more.missed;
  tooFar += more.tooFar;
  untrue += more.untrue;
  parts += more.parts;
  unresolved += more.unresolved;
  severalParts += more.severalParts;
  for (std::size_t i = 0; i < kNumEventKinds; ++i) kinds[i] += more.kinds[i];
  counters.add(more.counters);
  for (const std::string& problem : more.problems) {
    if (problems.size() < kMostProblems) problems.push_back(problem);
  }
}

JudgedEvents::JudgedEvents(BothWorlds& both, std::int64_t fromUs, const FollowOptions& options)
    : both_(both),
      follower_(WorldFollower::start(fromUs, options).value()),
      fromUs_(fromUs),
      untilUs_(fromUs),
      tolerance_(both.world.parts().options.tolerance) {}

/// Of an event or the order of events.
void JudgedEvents::sayUntrue(const std::string& what) {
  ++tally.untrue;
  say(what);
}

void JudgedEvents::say(const std::string& what) {
  if (tally.problems.size() < kMostProblems) tally.problems.push_back(what);
}

Real JudgedEvents::after(const WorldTime& time) const {
  return static_cast<Real>(time.us - fromUs_) + static_cast<Real>(time.fraction);
}

void JudgedEvents::follow(std::int64_t untilUs) {
  const auto done = follower_.follow(both_.world, untilUs, answer_);
  ASSERT_TRUE(done.ok()) << describe(done.error());
  events.insert(events.end(), answer_.events.begin(), answer_.events.end());
  parts_.insert(parts_.end(), answer_.parts.begin(), answer_.parts.end());
  EventTally more;
  more.counters = answer_.counters;
  tally.add(more);
  untilUs_ = answer_.toUs;
}

bool JudgedEvents::isAsked(BodyId a, LinkId linkOfA, BodyId b, LinkId linkOfB) const {
  if (a != b) return !both_.areJoined(a, linkOfA, b, linkOfB);
  const std::optional<PairRules>& own = both_.world.parts().body(a).options.self;
  return own && linkOfA < linkOfB && own->reasonOf(linkOfA, linkOfB) == PairReason::Asked;
}

void JudgedEvents::gather() {
  if (tamper) tamper(parts_);
  partsOf_.clear();
  for (const WorldPart& part : parts_) {
    ++tally.parts;
    const bool isContact = part.kind == PartKind::Contact;
    tally.unresolved += isContact ? 0 : 1;
    partsOf_[{part.a.body, part.a.link, part.b.body, part.b.link}].push_back(
        {static_cast<double>(after(part.from)), static_cast<double>(after(part.to)), isContact});
  }
  for (const auto& [links, parts] : partsOf_) {
    std::size_t begun = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      begun += i == 0 || parts[i].fromUs > parts[i - 1].toUs ? 1 : 0;
    }
    tally.severalParts += begun > 1 ? 1 : 0;
  }
}

void JudgedEvents::judge(int instants) {
  gather();
  judgeEvents();
  std::vector<Real> at;
  const Real length = static_cast<Real>(untilUs_ - fromUs_);
  for (int k = 0; k <= instants; ++k) at.push_back(length * k / instants);
  // A picosecond beside a change nothing has moved.
  constexpr Real kBeside[] = {-1e-3L, -1e-6L, 0.0L, 1e-6L, 1e-3L};
  for (const auto& [links, parts] : partsOf_) {
    for (const Part& part : parts) {
      for (const Real beside : kBeside) {
        at.push_back(static_cast<Real>(part.fromUs) + beside);
        at.push_back(static_cast<Real>(part.toUs) + beside);
      }
    }
  }
  at.erase(
      std::remove_if(at.begin(), at.end(), [length](Real us) { return us < 0 || us > length; }),
      at.end());
  for (BodyId a = 0; a < both_.world.numBodies(); ++a) {
    for (BodyId b = a; b < both_.world.numBodies(); ++b) {
      const bool isOwn = a == b;
      if (isOwn && !both_.world.parts().body(a).options.self) continue;
      if (!isOwn && !both_.world.parts().isAsked(a, b)) continue;
      judgePairs(a, b, at);
    }
  }
}

void JudgedEvents::judgePairs(BodyId a, BodyId b, const std::vector<Real>& instants) {
  const std::size_t linksOfA = both_.oracle.bodies[slotOf(a)].parents.size();
  const std::size_t linksOfB = both_.oracle.bodies[slotOf(b)].parents.size();
  std::vector<Judged> pairs;
  for (std::size_t i = 0; i < linksOfA * linksOfB; ++i) {
    const auto one = static_cast<LinkId>(i / linksOfB), other = static_cast<LinkId>(i % linksOfB);
    if (!isAsked(a, one, b, other)) continue;
    const auto told = partsOf_.find({a, one, b, other});
    pairs.push_back({i, one, other, told != partsOf_.end() ? &told->second : nullptr});
  }
  const Real beyond = 4 * static_cast<Real>(tolerance_);
  for (const Real us : instants) {
    const std::vector<Real> separations =
        both_.oracle.separationsAt(a, b, fromUs_, us, us > 0, beyond);
    for (const Judged& judged : pairs) judgeAt(a, b, judged, us, separations[judged.place]);
  }
}

void JudgedEvents::judgeAt(BodyId a, BodyId b, const Judged& judged, Real us, Real gap) {
  if (gap > 1e15L) return;  // one of the two has no parts
  ++tally.samples;
  tally.touching += gap <= 0 ? 1 : 0;
  if (judged.parts == nullptr && gap > 0) return;
  bool isCovered = false, isContact = false;
  for (std::size_t i = 0; judged.parts != nullptr && i < judged.parts->size(); ++i) {
    const Part& part = (*judged.parts)[i];
    if (us < part.fromUs || us > part.toUs) continue;
    isCovered = true;
    isContact = isContact || part.isContact;
  }
  tally.inContact += isContact ? 1 : 0;
  const Real most = 2 * static_cast<Real>(tolerance_) * (1 + Real(1e-9L));
  const bool isMissed = !isCovered && gap <= 0, isTooFar = isContact && gap > most;
  if (!isMissed && !isTooFar) return;
  ++(isMissed ? tally.missed : tally.tooFar);
  std::ostringstream what;
  what << "bodies " << a << ", " << b << ", links " << judged.linkOfA << ", " << judged.linkOfB
       << " at " << static_cast<double>(us) << " us, separation " << static_cast<double>(gap)
       << ": " << (isMissed ? "touching in free" : "too far in contact");
  say(what.str());
}

void JudgedEvents::judgeEvents() {
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    if (!comesBefore(events[i], events[i + 1])) sayUntrue("events are not in their order");
  }
  for (const WorldEvent& event : events) judgeEvent(event);
}

/// Where it says that they meet, and how far apart they are.
void JudgedEvents::judgeEvent(const WorldEvent& event) {
  ++tally.kinds[static_cast<std::size_t>(event.kind)];
  if (event.kind == EventKind::UnresolvedFrom || event.kind == EventKind::UnresolvedTo) return;
  const ContactSide &a = event.a, &b = event.b;
  // Who is put elsewhere, or not asked any more, is told where it was just before.
  const bool isApart = event.cause == LeaveCause::Apart;
  const Real us = after(event.time) - (isApart ? Real(0) : Real(1e-6L));
  std::ostringstream what;
  what << toString(event.kind) << " of bodies " << a.body << ", " << b.body << ", links " << a.link
       << ", " << b.link << " at " << static_cast<double>(us) << " us: ";
  if (event.numPoints == 0) {
    // Where an axis goes through a triangle, no point may be on both surfaces.
    const bool mayLack = (event.kind == EventKind::Leave && isApart) || event.penetration > 0.0;
    if (!mayLack) sayUntrue(what.str() + "no points");
    return;
  }
  const Real gap = both_.oracle.separationAt(a.body, a.link, b.body, b.link, fromUs_, us);
  const auto tolerance = static_cast<Real>(tolerance_);
  if (event.kind == EventKind::Leave) {
    if ((isApart && gap <= tolerance) || gap > 2 * tolerance)
      sayUntrue(what.str() + "leaves where it does not");
  } else if (gap > tolerance * (1 + Real(1e-9L))) {
    sayUntrue(what.str() + "enters too far away");
  }
  const Real told = static_cast<Real>(event.separation) - static_cast<Real>(event.penetration);
  if (event.penetration == 0.0 && std::abs(gap - told) > kPlaces)
    sayUntrue(what.str() + "separation");
  const Real off =
      std::max(both_.oracle.distanceToSurface(a.body, a.link, plain(a.p_W), fromUs_, us),
               both_.oracle.distanceToSurface(b.body, b.link, plain(b.p_W), fromUs_, us));
  // Where an axis goes through a triangle, no point of its surface is the nearest.
  if (event.penetration == 0.0 && off > kPlaces) sayUntrue(what.str() + "witness points");
  if (event.approachLower > event.approachSpeed || event.approachUpper < event.approachSpeed) {
    sayUntrue(what.str() + "bracket");
  }
}

}  // namespace foretouch::test
