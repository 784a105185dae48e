#include "tests/world_fuzz/fuzz_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "lss/index.h"

namespace foretouch::test {
namespace {

using oracle::OracleEpisode;
using oracle::OraclePart;
using oracle::Real;

constexpr double kEver = std::numeric_limits<double>::infinity();
constexpr double kSlackUs = 1e-6;

struct Span {
  double from = 0.0, to = kEver;
};
struct Spans {
  std::vector<Span> contact, unresolved;
  std::vector<Span> whole;  // unresolved: the two bodies altogether
};
using Pair = std::pair<BodyId, BodyId>;  // in this order; of a trigger: it and who is in it

struct Instant {
  double us = 0.0;
  bool isFromLeft = false;
};

class Judging {
 public:
  Judging(const FuzzWorld& world, const FuzzTold& told, FuzzTally& tally)
      : world_(world), told_(told), tally_(tally), base_(world.cuts.front()) {
    guard_ = 1e-12 + 64 * 0x1p-52 * world.reach;
    end_ = after(told.endUs);
    begin_ = after(told.beginUs);
  }

  void judge() {
    gather();
    findInstants();
    for (BodyId a = 0; a < numBodies(); ++a) {
      for (BodyId b = a + 1; b < numBodies(); ++b) {
        if (isAsked(a, b)) judgePair(a, b);
      }
    }
  }

 private:
  [[nodiscard]] BodyId numBodies() const { return static_cast<BodyId>(world_.bodies.size()); }
  [[nodiscard]] const FuzzBody& bodyOf(BodyId id) const { return world_.bodies[slotOf(id)]; }
  [[nodiscard]] const std::vector<OracleEpisode>& episodesOf(BodyId id) const {
    return world_.truth.bodies[slotOf(id)].episodes;
  }
  [[nodiscard]] double after(std::int64_t us) const { return static_cast<double>(us - base_); }
  [[nodiscard]] double after(const WorldTime& time) const { return after(time.us) + time.fraction; }

  void gather();
  void gatherEvent(const WorldEvent& event);
  void gatherTrigger(const TriggerEvent& event);
  void judgeBegin(const Pair& pair, double us);
  void findInstants();
  [[nodiscard]] bool isAsked(BodyId a, BodyId b) const;
  [[nodiscard]] const OracleEpisode* episodeAt(BodyId id, const Instant& at) const;
  [[nodiscard]] bool areJoined(BodyId a, BodyId b, const Instant& at) const;
  [[nodiscard]] bool isUnknown(BodyId id, double us) const;
  [[nodiscard]] double gapAt(BodyId a, BodyId b, const Instant& at) const;
  [[nodiscard]] double insideGapAt(BodyId trigger, BodyId b, const Instant& at) const;
  void judgePair(BodyId a, BodyId b);
  void judgeInstant(const Pair& pair, const Spans& spans, const Instant& at, double gap,
                    const char* what);
  void judgeWindow(BodyId a, BodyId b, const Instant& at, double gap);
  void say(FuzzFault fault, const Pair& pair, double us, const std::string& what);

  const FuzzWorld& world_;
  const FuzzTold& told_;
  FuzzTally& tally_;
  std::int64_t base_;
  double guard_ = 0.0, begin_ = 0.0, end_ = 0.0;
  std::map<Pair, Spans> pairs_, inside_;
  std::map<BodyId, std::vector<Span>> silent_;
  std::vector<Instant> instants_;
};

void Judging::say(FuzzFault fault, const Pair& pair, double us, const std::string& what) {
  std::ostringstream text;
  text.precision(17);
  text << bodyOf(pair.first).name;
  if (pair.second >= 0) text << " and " << bodyOf(pair.second).name;
  text << " at " << us << " us after the first cut: " << what;
  tally_.say(fault, text.str());
}

// What was told.

void Judging::gather() {
  const WorldEvent* last = nullptr;
  for (const WorldEvent& event : told_.events) {
    const Pair pair{event.a.body, event.b.body};
    const double us = after(event.time);
    if (last != nullptr && comesBefore(event, *last)) {
      say(FuzzFault::Order, pair, us, "comes too late among the events");
    }
    if (us < begin_ || us > end_) say(FuzzFault::Order, pair, us, "is out of the time");
    last = &event;
    gatherEvent(event);
  }
  for (std::size_t i = 0; i < told_.triggerEvents.size(); ++i) {
    const TriggerEvent& event = told_.triggerEvents[i];
    if (i > 0 && event.time < told_.triggerEvents[i - 1].time) {
      tally_.say(FuzzFault::Order, "events of triggers");
    }
    gatherTrigger(event);
  }
}

/// Begins or ends what two do; false if there is nothing to end, or it goes on already.
bool tell(std::vector<Span>& spans, bool begins, double us, double since) {
  const bool isOpen = !spans.empty() && spans.back().to == kEver;
  if (begins == isOpen) return false;
  if (begins) {
    spans.push_back({us, kEver});
    return true;
  }
  const bool isRight = spans.back().from == since;
  spans.back().to = us;
  return isRight;
}

void Judging::gatherEvent(const WorldEvent& event) {
  const double us = after(event.time), since = after(event.since);
  const bool begins = event.kind != EventKind::Leave && event.kind != EventKind::UnresolvedTo;
  const bool isUnresolved =
      event.kind == EventKind::UnresolvedFrom || event.kind == EventKind::UnresolvedTo;
  const Pair pair{event.a.body, event.b.body};
  if (event.b.body == kEveryBody) {
    if (!tell(silent_[event.a.body], begins, us, since)) {
      say(FuzzFault::Loose, {event.a.body, -1}, us, toString(event.kind));
    }
    return;
  }
  Spans& spans = pairs_[pair];
  const bool isWhole = event.a.link == kEveryLink;
  if (isUnresolved) {
    tally_.unresolved += begins ? 1 : 0;
    // What is unresolved ends a contact, without a leave.
    if (begins && !spans.contact.empty()) {
      spans.contact.back().to = std::min(spans.contact.back().to, us);
    }
  }
  std::vector<Span>& ofLinks = isUnresolved ? spans.unresolved : spans.contact;
  if (!tell(isWhole ? spans.whole : ofLinks, begins, us, since)) {
    say(FuzzFault::Loose, pair, us, toString(event.kind));
  }
  if (isUnresolved) return;
  if (!spans.whole.empty() && spans.whole.back().from < us && spans.whole.back().to == kEver) {
    say(FuzzFault::Loose, pair, us,
        std::string("inside what is unresolved: ") + toString(event.kind));
  }
  if (begins) {
    ++tally_.contacts;
    return judgeBegin(pair, us);
  }
  if (event.cause != LeaveCause::Apart) return;
  const double left = gapAt(pair.first, pair.second, {us, true});
  const double right = gapAt(pair.first, pair.second, {us, false});
  if (std::max(left, right) < world_.tolerance - guard_) {
    say(FuzzFault::Loose, pair, us, "they leave within the tolerance");
  }
  if (std::min(left, right) > 2 * world_.tolerance + guard_) {
    say(FuzzFault::Open, pair, us, "they leave too late");
  }
}

void Judging::judgeBegin(const Pair& pair, double us) {
  const double left = gapAt(pair.first, pair.second, {us, true});
  const double right = gapAt(pair.first, pair.second, {us, false});
  if (std::min(left, right) > world_.tolerance + guard_) {
    say(FuzzFault::Early, pair, us, "begins at " + std::to_string(std::min(left, right)));
  }
}

void Judging::gatherTrigger(const TriggerEvent& event) {
  // Triggers are the last bodies, in their order.
  BodyId trigger = 0;
  while (!bodyOf(trigger).isTrigger) ++trigger;
  trigger += event.trigger;
  const Pair pair{trigger, event.body};
  const double us = after(event.time), since = after(event.since);
  const bool begins = event.kind != EventKind::Leave && event.kind != EventKind::UnresolvedTo;
  const bool isUnresolved =
      event.kind == EventKind::UnresolvedFrom || event.kind == EventKind::UnresolvedTo;
  Spans& spans = inside_[pair];
  ++tally_.triggerEvents;
  if (isUnresolved && begins && !spans.contact.empty()) {
    spans.contact.back().to = std::min(spans.contact.back().to, us);
  }
  if (!tell(isUnresolved ? spans.unresolved : spans.contact, begins, us, since)) {
    say(FuzzFault::Loose, pair, us, std::string("trigger: ") + toString(event.kind));
  }
  if (!begins || isUnresolved) return;
  const double gap = std::min(insideGapAt(trigger, event.body, {us, true}),
                              insideGapAt(trigger, event.body, {us, false}));
  if (gap > world_.tolerance + guard_) say(FuzzFault::Early, pair, us, "in a trigger");
}

// What is true.

/// Every change of motion from both sides, three instants between two of them, and all events'.
void Judging::findInstants() {
  std::vector<double> knots{begin_, end_};
  for (BodyId id = 0; id < numBodies(); ++id) {
    for (const OracleEpisode& episode : episodesOf(id)) {
      for (const std::int64_t us : episode.times) knots.push_back(after(us));
    }
  }
  std::sort(knots.begin(), knots.end());
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (knots[i] < begin_ || knots[i] > end_) continue;
    if (knots[i] > begin_) instants_.push_back({knots[i], true});
    if (knots[i] >= end_) continue;
    instants_.push_back({knots[i], false});
    const double length = std::min(end_, knots[i + 1]) - knots[i];
    for (const double share : {0.13, 0.37, 0.5, 0.71, 0.93}) {
      instants_.push_back({knots[i] + share * length, false});
    }
  }
}

bool Judging::isAsked(BodyId a, BodyId b) const {
  const FuzzBody &one = bodyOf(a), &other = bodyOf(b);
  if (one.isBox && other.isBox) return false;  // two meshes
  if (one.isTrigger && other.isTrigger) return false;
  if (one.isTrigger || other.isTrigger) return true;
  return !world_.areApart || one.group == other.group;
}

const OracleEpisode* Judging::episodeAt(BodyId id, const Instant& at) const {
  const OracleEpisode* found = nullptr;
  for (const OracleEpisode& episode : episodesOf(id)) {
    const double begin = after(episode.beginUs);
    if (begin < at.us || (begin == at.us && !at.isFromLeft)) found = &episode;
  }
  return found;
}

bool Judging::areJoined(BodyId a, BodyId b, const Instant& at) const {
  return episodeAt(a, at)->carrier == b || episodeAt(b, at)->carrier == a;
}

bool isIn(const std::vector<Span>& spans, double us, double slack) {
  return std::any_of(spans.begin(), spans.end(), [&](const Span& span) {
    return us >= span.from - slack && us <= span.to + slack;
  });
}

/// It is silent and told to be, or who carries it.
bool Judging::isUnknown(BodyId id, double us) const {
  for (int left = 0; left < numBodies() && id >= 0; ++left) {
    const auto silent = silent_.find(id);
    if (silent != silent_.end() && bodyOf(id).whenSilent == "undecided" &&
        isIn(silent->second, us, kSlackUs)) {
      return true;
    }
    const OracleEpisode* const episode = episodeAt(id, {us, false});
    id = episode == nullptr ? -1 : episode->carrier;
  }
  return false;
}

double Judging::gapAt(BodyId a, BodyId b, const Instant& at) const {
  if (a < 0 || b < 0 || episodeAt(a, at) == nullptr || episodeAt(b, at) == nullptr) return kEver;
  constexpr Real kAll = 1e30L;
  return static_cast<double>(
      world_.truth.separationsAt(a, b, base_, static_cast<Real>(at.us), at.isFromLeft, kAll)[0]);
}

/// Below zero where a point of the other one is in the trigger, which may be a box.
double Judging::insideGapAt(BodyId trigger, BodyId b, const Instant& at) const {
  const double gap = gapAt(trigger, b, at);
  const FuzzBody& box = bodyOf(trigger);
  if (gap == kEver || gap < 0 || !box.isBox || bodyOf(b).parts.empty()) return gap;
  const auto us = static_cast<Real>(at.us);
  const auto frame = world_.truth.frameAt(trigger, 0, base_, us, at.isFromLeft);
  const auto other = world_.truth.frameAt(b, 0, base_, us, at.isFromLeft);
  for (const OraclePart& part : bodyOf(b).parts) {
    const auto p = rotate(conjugate(frame.q), other.at(part.corners[0].as<Real>()) - frame.p);
    if (extent(p) < static_cast<Real>(box.half)) return -gap;
  }
  return gap;
}

void Judging::judgePair(BodyId a, BodyId b) {
  static const Spans kNothing;
  const auto spansOf = [&](const std::map<Pair, Spans>& of, const Pair& pair) -> const Spans& {
    const auto found = of.find(pair);
    return found == of.end() ? kNothing : found->second;
  };
  const Spans& spans = spansOf(pairs_, {a, b});
  const bool isOfTrigger = bodyOf(b).isTrigger;
  const bool isWatched = isOfTrigger && (bodyOf(b).watches < 0 || bodyOf(b).watches == a);
  for (const Instant& at : instants_) {
    if (episodeAt(a, at) == nullptr || episodeAt(b, at) == nullptr) continue;
    if (areJoined(a, b, at) || isUnknown(a, at.us) || isUnknown(b, at.us)) continue;
    ++tally_.pairInstants;
    const double gap = gapAt(a, b, at);
    judgeInstant({a, b}, spans, at, gap, "");
    if (!isOfTrigger) judgeWindow(a, b, at, gap);
    if (isWatched && !(bodyOf(a).isBox && bodyOf(b).isBox)) {
      judgeInstant({b, a}, spansOf(inside_, {b, a}), at, insideGapAt(b, a, at), "trigger: ");
    }
  }
}

void Judging::judgeInstant(const Pair& pair, const Spans& spans, const Instant& at, double gap,
                           const char* what) {
  if (isIn(spans.unresolved, at.us, kSlackUs) || isIn(spans.whole, at.us, kSlackUs)) return;
  if (gap < -guard_ && !isIn(spans.contact, at.us, kSlackUs)) {
    const auto next = std::find_if(instants_.begin(), instants_.end(), [&](const Instant& other) {
      return other.us > at.us && other.isFromLeft;
    });
    const double untilUs = next == instants_.end() ? end_ : next->us;
    const bool isLate =
        std::any_of(spans.contact.begin(), spans.contact.end(),
                    [&](const Span& span) { return span.from > at.us && span.from < untilUs; });
    say(isLate ? FuzzFault::Late : FuzzFault::Missed, pair, at.us,
        what + std::string("touch by ") + std::to_string(-gap / world_.size) + " sizes");
  }
  if (gap > 2 * world_.tolerance + guard_ && isIn(spans.contact, at.us, -kSlackUs)) {
    say(FuzzFault::Open, pair, at.us, what + std::string("in contact, and apart"));
  }
}

/// The first contact in a window, or where nothing is claimed from.
void Judging::judgeWindow(BodyId a, BodyId b, const Instant& at, double gap) {
  if (!(gap < -guard_)) return;
  for (std::size_t i = 0; i + 1 < told_.cuts.size(); ++i) {
    const double from = after(told_.cuts[i]), to = after(told_.cuts[i + 1]);
    if (at.us < from || at.us > to || at.us == (at.isFromLeft ? from : to)) continue;
    const auto& contacts = told_.windows[i].contacts;
    const bool isTold =
        std::any_of(contacts.begin(), contacts.end(), [&](const WorldContact& contact) {
          return contact.a.body == a && contact.b.body == b &&
                 after(contact.time) <= at.us + kSlackUs;
        });
    if (!isTold) say(FuzzFault::Missed, {a, b}, at.us, "no first contact in its window");
  }
}

}  // namespace

void FuzzTally::say(FuzzFault fault, const std::string& what) {
  ++faults[static_cast<std::size_t>(fault)];
  if (first.empty()) first = kFuzzFaults[static_cast<std::size_t>(fault)] + (": " + what);
}

void FuzzTally::add(const FuzzTally& more) {
  worlds += more.worlds;
  pairInstants += more.pairInstants;
  contacts += more.contacts;
  triggerEvents += more.triggerEvents;
  unresolved += more.unresolved;
  for (std::size_t i = 0; i < faults.size(); ++i) faults[i] += more.faults[i];
  if (first.empty()) first = more.first;
}

std::uint64_t FuzzTally::wrong() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : faults) sum += count;
  return sum;
}

void judgeFuzzWorld(const FuzzWorld& world, const FuzzTold& told, FuzzTally& tally) {
  Judging(world, told, tally).judge();
}

}  // namespace foretouch::test
