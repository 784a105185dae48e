#include "middleware/events/interval_tracer.h"

#include <algorithm>
#include <utility>

#include "lss/rounding.h"
#include "middleware/events/contact_hold.h"
#include "middleware/pair/link_query.h"

namespace foretouch::internal {
namespace {

/// Shares of the tolerance: a contact goes on until the two are farther apart than the first, and
/// is proven to stay within the second; the rest of twice the tolerance is for the rounding of
/// instants (events.md 1).
constexpr double kLeaveShare = 1.5, kLimitShare = 2.0 - 0x1p-6;

/// A search through more pairs at once is cut in halves of time, if that leaves fewer.
constexpr std::size_t kMostPairs = 192;
constexpr double kLeastPiece = 0x1p-10;
/// A share of the rest of the motion: a proof for so long is taken, instead of looking for a longer
/// one among all pairs that are near, of which there may be hundreds.
constexpr double kEnoughShare = 0.25;

}  // namespace

IntervalTolerance IntervalTolerance::of(double tolerance, double off) {
  return {tolerance - off, kLeaveShare * tolerance, kLimitShare * tolerance - off,
          kFloorShare * tolerance};
}

void IntervalTracer::trace(MovingSides& sides, const IntervalTolerance& tolerance, double from,
                           TraceStart start, SidesPair& witness, std::vector<StepPart>& parts,
                           EventCounters& counters) {
  sides_ = &sides;
  tolerance_ = tolerance;
  last_ = witness;
  traceParts(from, start, parts, counters);
  witness = last_;
}

IntervalTracer::Search IntervalTracer::search(MovingSides& sides,
                                              const IntervalTolerance& tolerance, double from,
                                              double to, double firstSpan, SidesPair& witness,
                                              EventCounters& counters) {
  sides_ = &sides;
  tolerance_ = tolerance;
  last_ = witness;
  const Search found = searchContact(from, to, firstSpan, counters);
  witness = last_;
  return found;
}

void IntervalTracer::leaveUnresolved(double from, std::vector<StepPart>& parts) const {
  const auto reason = sides_->isSpent() ? UndecidedReason::WorkBudget : UndecidedReason::Resolution;
  parts.push_back({PartKind::Unresolved, from, 1.0, true, reason});
}

void IntervalTracer::traceParts(double from, TraceStart start, std::vector<StepPart>& parts,
                                EventCounters& counters) {
  if (sides_->isSpent()) return leaveUnresolved(from, parts);
  double t = from;
  bool isContact = start == TraceStart::Contact;
  if (!isContact) {
    // Most often the begin is where a contact was found.
    ++counters.freeLooks;
    isContact = isWithin(t, tolerance_.enter);
  }
  for (;;) {
    if (!isContact) {
      const Search search = searchContact(t, 1.0, 1.0, counters);
      if (search.found == Found::Nothing) return;
      if (search.found == Found::Unresolved) {
        return leaveUnresolved(search.t, parts);
      }
      t = search.t;
    }
    const double begin = t;
    const bool isKnown = followContact(t, counters);
    parts.push_back({PartKind::Contact, begin, t, isKnown && t >= 1.0, UndecidedReason::None});
    if (!isKnown) return leaveUnresolved(t, parts);
    if (t >= 1.0) return;
    isContact = false;
  }
}

/// A pair that shows it is the one that is tried first from then on.
bool IntervalTracer::isWithin(double t, double within) {
  if (!last_.isNone() && sides_->at(last_, t).gapUpper <= within) return true;
  sides_->collect(t, t, within, near_);
  const auto found = std::find_if(near_.begin(), near_.end(), [&](const SidesPair& pair) {
    return sides_->at(pair, t).gapUpper <= within;
  });
  if (found == near_.end()) return false;
  last_ = *found;
  return true;
}

bool IntervalTracer::tryHold(const SidesPair& pair, double t, double within, Hold& best) {
  const MovingPair now = sides_->at(pair, t);
  if (now.gapUpper > within) return false;
  best.isContact = true;
  const double rest = 1.0 - t;
  double step = staysWithin(now, tolerance_.limit, rest);
  if (step < rest) step = std::max(step, staysPierced(now, rest));
  if (step > best.step || last_.isNone()) {
    best.step = std::max(best.step, step);
    last_ = pair;
  }
  return true;
}

/// A proof that is long enough, by the pair that served before if it can; else the longest one.
IntervalTracer::Hold IntervalTracer::holdAt(double t, double within) {
  const double enough = kEnoughShare * (1.0 - t);
  Hold best;
  if (!last_.isNone() && tryHold(last_, t, within, best) && best.step >= enough) return best;
  const SidesPair tried = last_;
  sides_->collect(t, t, within, near_);
  for (const SidesPair& pair : near_) {
    if (pair == tried) continue;
    (void)tryHold(pair, t, within, best);
    if (best.step >= enough) break;
  }
  return best;
}

bool IntervalTracer::followContact(double& t, EventCounters& counters) {
  while (t < 1.0) {
    if (sides_->isSpent()) return false;
    ++counters.contactLooks;
    const Hold hold = holdAt(t, tolerance_.leave);
    if (!hold.isContact) return true;
    const double next = timeAfter(t, hold.step, 1.0);
    if (!(next > t)) return false;
    t = next;
  }
  return true;
}

IntervalTracer::Search IntervalTracer::searchContact(double from, double to, double firstSpan,
                                                     EventCounters& counters) {
  double begin = from, end = std::min(to, from + firstSpan);
  while (begin < to) {
    if (sides_->isSpent()) return {Found::Unresolved, begin};
    sides_->collect(begin, end, tolerance_.enter, near_);
    end = cutPiece(begin, end);
    const Search search = searchPiece(begin, end, counters);
    if (search.found != Found::Nothing) return search;
    const double span = end - begin;
    begin = end;
    end = std::min(to, begin + 2.0 * span);
  }
  return {};
}

/// Halves the piece while that leaves half of its many pairs, or fewer: those that are near
/// throughout would be looked at in every piece.
double IntervalTracer::cutPiece(double begin, double end) {
  while (near_.size() > kMostPairs && end - begin > kLeastPiece) {
    const double middle = 0.5 * (begin + end);
    sides_->collect(begin, middle, tolerance_.enter, fewer_);
    if (2 * fewer_.size() > near_.size()) return end;
    std::swap(near_, fewer_);
    end = middle;
  }
  return end;
}

/// Searches the pairs of near_: all others stay farther than `enter` apart in the piece.
IntervalTracer::Search IntervalTracer::searchPiece(double from, double to,
                                                   EventCounters& counters) {
  const auto isLater = [](const Candidate& x, const Candidate& y) {
    return x.freeUntil > y.freeUntil;
  };
  heap_.clear();
  for (const SidesPair& pair : near_) heap_.push_back({from, pair});
  double looked = -1.0;
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), isLater);
    Candidate& candidate = heap_.back();
    const double t = candidate.freeUntil;
    if (t >= to) return {};
    if (sides_->isSpent()) return {Found::Unresolved, t};
    counters.freeLooks += t != looked ? 1 : 0;
    looked = t;
    const MovingPair pair = sides_->at(candidate.pair, t);
    if (pair.gapUpper <= tolerance_.enter) {
      last_ = candidate.pair;
      return {Found::Contact, t};
    }
    const double next = timeAfter(t, pair.stepFrom(tolerance_.floor), to);
    if (!(next > t)) return {Found::Unresolved, t};
    candidate.freeUntil = next;
    std::push_heap(heap_.begin(), heap_.end(), isLater);
  }
  return {};
}

}  // namespace foretouch::internal
