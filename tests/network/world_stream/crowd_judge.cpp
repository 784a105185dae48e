#include "tests/network/world_stream/crowd_judge.h"

#include <cmath>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "lss/index.h"
#include "tests/network/world_stream/crowd_late.h"
#include "tests/support/judged.h"

namespace foretouch::test {
namespace {

using oracle::OracleOutcome;
using oracle::OracleTouch;
using oracle::OracleWorld;
using oracle::Real;

constexpr double kSlackUs = 1.0;
/// The judge's places and the product's, in metres.
constexpr double kPlaces = 1e-9;
constexpr std::size_t kMostShown = 5;

/// What goes on ends there.
void endLast(TimeSpans& spans, double us) {
  if (!spans.empty() && spans.back().to == kEver) spans.back().to = us;
}

class Judging {
 public:
  Judging(const Crowd& crowd, const CrowdTold& told, CrowdTally& tally,
          std::vector<std::string>& violations)
      : truth_(crowd.truth),
        world_(crowd.truth.world),
        told_(told),
        tally_(tally),
        violations_(violations),
        tolerance_(crowd.setup.options.tolerance),
        numBodies_(static_cast<BodyNumber>(crowd.truth.world.bodies.size())) {
    if (truth_.still) world_.bodies.push_back(*truth_.still);
    whole_ = {after(told.answers.front().fromUs), after(told.answers.back().toUs)};
  }

  void judge() {
    gather();
    for (BodyNumber body = 0; body < numBodies_; ++body) {
      late_.push_back(lateSpans(truth_, told_.heard[slotOf(body)], body, whole_));
      absent_.push_back(absentOf(body));
    }
    for (const EventsMessage& answer : told_.answers) {
      for (const ToldEvent& event : answer.events) judgeEvent(event);
    }
    for (BodyNumber a = 0; a < numBodies_; ++a) {
      for (BodyNumber b = a; b < numBodies_; ++b) judgePair(a, b);
      if (truth_.still && isMadeOfLss(a)) judgeLinks({a, 0, numBodies_, 0});
    }
  }

 private:
  /// Body, link, body, link; the scene comes last.
  struct Pair {
    BodyNumber a = 0;
    LinkId linkOfA = 0;
    BodyNumber b = 0;
    LinkId linkOfB = 0;
    bool operator<(const Pair& o) const {
      return std::tie(a, linkOfA, b, linkOfB) < std::tie(o.a, o.linkOfA, o.b, o.linkOfB);
    }
  };
  struct Parts {
    TimeSpans contact, unresolved;
  };
  struct UnknownLink {
    LinkId link;
    TimeSpan span;
  };

  // What was told.
  void gather();
  void gather(const ToldEvent& told);
  [[nodiscard]] Pair pairOf(const WorldEvent& event) const;
  void endAll(BodyNumber body, double us);
  void beginAnew(double us);

  // What is not claimed.
  [[nodiscard]] TimeSpans absentOf(BodyNumber body) const;
  [[nodiscard]] TimeSpans unknownOf(BodyNumber body, LinkId link) const;
  [[nodiscard]] TimeSpans joinedOf(const Pair& pair) const;
  [[nodiscard]] TimeSpan spanOf(BodyNumber body, std::size_t state) const;

  void judgeEvent(const ToldEvent& told);
  void count(const Pair& pair, double us);
  void judgePlace(const WorldEvent& event, const Pair& pair, double us);
  void judgePair(BodyNumber a, BodyNumber b);
  void judgeLinks(const Pair& pair);
  void judgeContact(const Pair& pair, const TimeSpans& contact, const TimeSpans& notClaimed);
  [[nodiscard]] bool isMadeOfLss(BodyNumber body) const {
    return world_.bodies[slotOf(body)].parts.front().count == 2;
  }
  [[nodiscard]] Real gapAt(const Pair& pair, double us, bool isFromLeft) const;
  void say(const Pair& pair, double us, const std::string& what);

  const CrowdTruth& truth_;
  OracleWorld world_;
  const CrowdTold& told_;
  CrowdTally& tally_;
  std::vector<std::string>& violations_;
  double tolerance_;
  BodyNumber numBodies_;
  TimeSpan whole_;
  std::map<Pair, Parts> parts_;
  std::map<BodyNumber, std::vector<UnknownLink>> unknown_;
  std::map<BodyNumber, TimeSpans> unresolved_;
  std::vector<TimeSpans> late_, absent_;
};

void Judging::say(const Pair& pair, double us, const std::string& what) {
  if (violations_.size() >= kMostShown) return;
  std::ostringstream text;
  text.precision(12);
  text << "bodies " << pair.a << ", " << pair.b << ", links " << pair.linkOfA << ", "
       << pair.linkOfB << " at " << us << " us: " << what;
  violations_.push_back(text.str());
}

// What was told.

void Judging::gather() {
  std::int64_t timeline = told_.answers.front().timeline;
  for (const EventsMessage& answer : told_.answers) {
    if (answer.timeline != timeline) beginAnew(after(answer.fromUs));
    timeline = answer.timeline;
    for (const UnknownPart& part : answer.unknown) {
      unknown_[part.body].push_back({part.link, {after(part.fromUs), after(part.toUs)}});
    }
    for (const ToldEvent& event : answer.events) gather(event);
  }
}

Judging::Pair Judging::pairOf(const WorldEvent& event) const {
  const auto numberOf = [this](BodyNumber body) { return body == kStillScene ? numBodies_ : body; };
  Pair pair{numberOf(event.a.body), event.a.link, numberOf(event.b.body), event.b.link};
  const Pair other{pair.b, pair.linkOfB, pair.a, pair.linkOfA};
  if (other < pair) pair = other;
  if (pair.b == numBodies_) pair.linkOfB = 0;
  return pair;
}

void Judging::endAll(BodyNumber body, double us) {
  for (auto& [pair, parts] : parts_) {
    if (pair.a != body && pair.b != body) continue;
    endLast(parts.contact, us);
  }
}

/// Of another timeline: all contacts begin anew.
void Judging::beginAnew(double us) {
  for (auto& [pair, parts] : parts_) {
    for (TimeSpans* const spans : {&parts.contact, &parts.unresolved}) endLast(*spans, us);
  }
  for (auto& [body, spans] : unresolved_) endLast(spans, us);
}

void Judging::gather(const ToldEvent& told) {
  const WorldEvent& event = told.event;
  const double us = after(event.time);
  if (told.cause == ToldCause::BodyGone) return endAll(event.a.body, us);
  if (event.b.body == kEveryBody) {
    TimeSpans& spans = unresolved_[event.a.body];
    if (event.kind == EventKind::UnresolvedFrom) spans.push_back({us, kEver});
    if (event.kind == EventKind::UnresolvedTo) endLast(spans, us);
    return;
  }
  Parts& parts = parts_[pairOf(event)];
  switch (event.kind) {
    case EventKind::Enter:
    case EventKind::StartsInside: parts.contact.push_back({us, kEver}); break;
    case EventKind::Leave: endLast(parts.contact, us); break;
    case EventKind::UnresolvedFrom:
      endLast(parts.contact, us);
      parts.unresolved.push_back({us, kEver});
      break;
    case EventKind::UnresolvedTo: endLast(parts.unresolved, us); break;
  }
}

// What is not claimed.

TimeSpan Judging::spanOf(BodyNumber body, std::size_t state) const {
  const std::vector<CrowdState>& states = truth_.states[slotOf(body)];
  return {after(states[state].sinceUs),
          state + 1 < states.size() ? after(states[state + 1].sinceUs) : kEver};
}

TimeSpans Judging::absentOf(BodyNumber body) const {
  const std::optional<std::int64_t> since = told_.presentUs[slotOf(body)];
  if (!since) return {{-kEver, kEver}};
  TimeSpans absent{{-kEver, after(*since)}};
  const std::vector<CrowdState>& states = truth_.states[slotOf(body)];
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].isPresent) absent.push_back(spanOf(body, i));
  }
  return absent;
}

/// Of a link, by what was listed, of it or of who carries it.
TimeSpans Judging::unknownOf(BodyNumber body, LinkId link) const {
  TimeSpans spans;
  if (body == numBodies_) return spans;
  for (const BodyNumber of : {body, kEveryBody}) {
    const auto listed = unknown_.find(of);
    if (listed == unknown_.end()) continue;
    for (const UnknownLink& part : listed->second) {
      if (part.link == kEveryLink || link == kEveryLink || part.link == link) {
        spans.push_back(part.span);
      }
    }
  }
  const std::vector<CrowdState>& states = truth_.states[slotOf(body)];
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].carrier == kNoBody) continue;
    add(spans, clipped(unknownOf(states[i].carrier, states[i].link), spanOf(body, i)));
  }
  return spans;
}

/// A prop and the link that carries it are not asked.
TimeSpans Judging::joinedOf(const Pair& pair) const {
  TimeSpans joined;
  const auto addOf = [&](BodyNumber body, BodyNumber carrier, LinkId link) {
    if (body == numBodies_) return;
    const std::vector<CrowdState>& states = truth_.states[slotOf(body)];
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i].carrier == carrier && states[i].link == link) {
        joined.push_back(spanOf(body, i));
      }
    }
  };
  addOf(pair.a, pair.b, pair.linkOfB);
  addOf(pair.b, pair.a, pair.linkOfA);
  return joined;
}

// Judgements.

Real Judging::gapAt(const Pair& pair, double us, bool isFromLeft) const {
  const std::vector<Real> gaps = world_.separationsAt(pair.a, pair.b, kCrowdBaseUs,
                                                      static_cast<Real>(us), isFromLeft, Real(1));
  const std::size_t linksOfB = world_.bodies[slotOf(pair.b)].parents.size();
  return gaps[slotOf(pair.linkOfA) * linksOfB + slotOf(pair.linkOfB)];
}

void Judging::count(const Pair& pair, double us) {
  const auto isAvatar = [this](BodyNumber body) {
    return body < numBodies_ && world_.bodies[slotOf(body)].parents.size() > 1;
  };
  const auto isCarried = [&](BodyNumber body) {
    if (body == numBodies_) return false;
    const CrowdState* const state = truth_.stateAt(body, microsecond(us));
    return state != nullptr && state->carrier != kNoBody;
  };
  if (isCarried(pair.a) || isCarried(pair.b)) ++tally_.ofCarried;
  if (pair.b == numBodies_) {
    ++tally_.ofScene;
  } else if (pair.a == pair.b) {
    ++tally_.ofOwnLinks;
  } else {
    const int avatars = (isAvatar(pair.a) ? 1 : 0) + (isAvatar(pair.b) ? 1 : 0);
    ++(avatars == 2 ? tally_.ofAvatars : avatars == 1 ? tally_.ofAvatarAndProp : tally_.ofProps);
  }
}

void Judging::judgeEvent(const ToldEvent& told) {
  const WorldEvent& event = told.event;
  const bool isOfTwo = event.b.body != kEveryBody && told.cause != ToldCause::BodyGone &&
                       event.a.link != kEveryLink && event.b.link != kEveryLink;
  if (!isOfTwo) return;
  ++tally_.events;
  tally_.marked += event.isAssumed ? 1 : 0;
  const Pair pair = pairOf(event);
  const double us = after(event.time);
  const bool isUnresolved =
      event.kind == EventKind::UnresolvedFrom || event.kind == EventKind::UnresolvedTo;
  if (event.isAssumed || isUnresolved) return;
  const auto touchesLate = [&](BodyNumber body) {
    return body < numBodies_ && isIn(late_[slotOf(body)], us, kSlackUs);
  };
  if (touchesLate(pair.a) || touchesLate(pair.b)) return;
  const bool isUnknown = isIn(unknownOf(pair.a, pair.linkOfA), us, -2 * kSlackUs) ||
                         isIn(unknownOf(pair.b, pair.linkOfB), us, -2 * kSlackUs);
  if (isUnknown) return say(pair, us, "rests on what is not known, and is not marked");
  const auto isGone = [&](BodyNumber body) {
    return body < numBodies_ && absent_[slotOf(body)].size() > 1 &&
           us > absent_[slotOf(body)].back().from + kSlackUs;
  };
  if (isGone(pair.a) || isGone(pair.b)) return say(pair, us, "of a body that is gone");
  count(pair, us);
  judgePlace(event, pair, us);
}

void Judging::judgePlace(const WorldEvent& event, const Pair& pair, double us) {
  // The two differ where a body changes its carrier.
  const double left = static_cast<double>(gapAt(pair, us, true));
  const double right = static_cast<double>(gapAt(pair, us, false));
  const double least = std::min(left, right), most = std::max(left, right);
  const double within = tolerance_ + kPlaces;
  if (event.kind == EventKind::Leave) {
    const bool isAsked = !isIn(joinedOf(pair), us, kSlackUs);
    if (isAsked && (most <= tolerance_ - kPlaces || least > 2 * within)) {
      say(pair, us, "leaves where it does not: " + std::to_string(least));
    }
    return;
  }
  if (least > within) {
    say(pair, us, std::string(toString(event.kind)) + " at a distance of " + std::to_string(least));
    return;
  }
  if (left != right || event.penetration != 0.0) return;
  const bool isSwapped = event.a.body != pair.a || event.a.link != pair.linkOfA;
  const ContactSide &one = isSwapped ? event.b : event.a, &other = isSwapped ? event.a : event.b;
  const auto at = static_cast<Real>(us);
  const Real off =
      std::max(world_.distanceToSurface(pair.a, pair.linkOfA, plain(one.p_W), kCrowdBaseUs, at),
               world_.distanceToSurface(pair.b, pair.linkOfB, plain(other.p_W), kCrowdBaseUs, at));
  if (off > static_cast<Real>(kPlaces)) say(pair, us, "its points are not where the two are");
}

void Judging::judgePair(BodyNumber a, BodyNumber b) {
  const std::optional<PairRules>& self = truth_.self[slotOf(a)];
  if (a == b && !self) return;
  if (a != b && !isMadeOfLss(a) && !isMadeOfLss(b)) return;  // two meshes are not asked
  const auto linksOf = [this](BodyNumber body) {
    return static_cast<LinkId>(world_.bodies[slotOf(body)].parents.size());
  };
  for (LinkId one = 0; one < linksOf(a); ++one) {
    for (LinkId other = a == b ? one + 1 : 0; other < linksOf(b); ++other) {
      if (a == b && self->reasonOf(one, other) != PairReason::Asked) continue;
      judgeLinks({a, one, b, other});
    }
  }
}

void Judging::judgeLinks(const Pair& pair) {
  static const Parts kNothing;
  const auto found = parts_.find(pair);
  const Parts& parts = found == parts_.end() ? kNothing : found->second;
  TimeSpans notClaimed = joinedOf(pair), late, unknown = parts.unresolved;
  for (const auto& [body, link] : {std::pair(pair.a, pair.linkOfA), {pair.b, pair.linkOfB}}) {
    if (body == numBodies_) continue;
    add(notClaimed, absent_[slotOf(body)]);
    add(late, late_[slotOf(body)]);
    add(unknown, unknownOf(body, link));
    const auto unresolved = unresolved_.find(body);
    if (unresolved != unresolved_.end()) add(unknown, unresolved->second);
  }
  const auto covered = [&](const TimeSpans& spans) {
    return 1e-6 * (whole_.to - whole_.from - lengthOf(rest(spans, whole_)));
  };
  tally_.unknownSeconds += covered(unknown);
  tally_.lateSeconds += covered(late);
  add(notClaimed, late);
  add(notClaimed, unknown);
  judgeContact(pair, parts.contact, notClaimed);
  add(notClaimed, parts.contact);
  for (const TimeSpan& span : rest(std::move(notClaimed), whole_)) {
    const std::int64_t fromUs = microsecond(std::ceil(span.from)), toUs = microsecond(span.to);
    if (fromUs >= toUs) continue;
    ++tally_.freeSpans;
    tally_.freeSeconds += 1e-6 * static_cast<double>(toUs - fromUs);
    const OracleTouch touch =
        world_.firstTouch(pair.a, pair.linkOfA, pair.b, pair.linkOfB, fromUs, toUs);
    if (touch.outcome == OracleOutcome::Uncertain) ++tally_.unproved;
    if (touch.outcome == OracleOutcome::Touch) {
      say(pair, after(fromUs) + static_cast<double>(touch.time), "missed");
    }
  }
}

/// At both ends, and between them.
void Judging::judgeContact(const Pair& pair, const TimeSpans& contact,
                           const TimeSpans& notClaimed) {
  constexpr int kInstants = 8;
  for (const TimeSpan& span : clipped(contact, whole_)) {
    for (int i = 0; i <= kInstants; ++i) {
      const double us = span.from + (span.to - span.from) * i / kInstants;
      if (isIn(notClaimed, us, kSlackUs)) continue;
      ++tally_.touching;
      // Where a body changes its carrier a contact ends, or begins, at one of the two places.
      const Real gap = std::min(gapAt(pair, us, false), gapAt(pair, us, true));
      if (gap <= static_cast<Real>(2 * tolerance_ + kPlaces)) continue;
      say(pair, us, "in contact at a distance of " + std::to_string(static_cast<double>(gap)));
    }
  }
}

}  // namespace

void CrowdTally::add(const CrowdTally& more) {
  const auto into = [&](auto CrowdTally::*field) { this->*field += more.*field; };
  for (const auto field :
       {&CrowdTally::seeds, &CrowdTally::events, &CrowdTally::marked, &CrowdTally::ofAvatars,
        &CrowdTally::ofAvatarAndProp, &CrowdTally::ofProps, &CrowdTally::ofOwnLinks,
        &CrowdTally::ofScene, &CrowdTally::ofCarried, &CrowdTally::touching, &CrowdTally::freeSpans,
        &CrowdTally::unproved, &CrowdTally::refused, &CrowdTally::silences, &CrowdTally::gaps,
        &CrowdTally::lateChanges, &CrowdTally::failures}) {
    into(field);
  }
  for (const auto field :
       {&CrowdTally::freeSeconds, &CrowdTally::unknownSeconds, &CrowdTally::lateSeconds}) {
    into(field);
  }
}

void judgeCrowd(const Crowd& crowd, const CrowdTold& told, CrowdTally& tally,
                std::vector<std::string>& violations) {
  ++tally.seeds;
  tally.refused += told.counts.rejected();
  tally.silences += told.counts.silences;
  tally.gaps += told.counts.gaps;
  tally.lateChanges += told.counts.lateChanges;
  tally.failures += told.counts.failures;
  if (!told.answers.empty()) Judging(crowd, told, tally, violations).judge();
}

}  // namespace foretouch::test
