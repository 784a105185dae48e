#include "middleware/pair/backtracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lss/assert.h"
#include "lss/rounding.h"
#include "middleware/pair/start.h"

namespace foretouch::internal {
namespace {

/// Later first, so that the standard heap's top is the earliest; the triangle makes the order
/// total.
struct Later {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.freeUntil != y.freeUntil) return x.freeUntil > y.freeUntil;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    if (x.lss != y.lss) return x.lss > y.lss;
    if (x.otherLss != y.otherLss) return x.otherLss > y.otherLss;
    if (!(x.part == y.part)) return y.part < x.part;
    return y.otherPart < x.otherPart;
  }
};

/// Farther first, so that the heap's top is the nearest; total, too.
struct Farther {
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.nearest != y.nearest) return x.nearest > y.nearest;
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    if (x.lss != y.lss) return x.lss > y.lss;
    if (x.otherLss != y.otherLss) return x.otherLss > y.otherLss;
    if (!(x.part == y.part)) return y.part < x.part;
    return y.otherPart < x.otherPart;
  }
};

class Backtracker {
 public:
  Backtracker(const LinkQuery& query, std::vector<Candidate>& heap, QueryCounters& counters)
      : query_(query), heap_(heap), counters_(counters), states_(query, counters) {}

  PairContact run() {
    startCandidates();
    while (!heap_.empty() && !hasContact() && heap_.front().freeUntil <= horizon_) {
      if (query_.meter.isPartSpent(counters_)) {
        giveUp(heap_.front().freeUntil, UndecidedReason::WorkBudget);
        break;
      }
      std::pop_heap(heap_.begin(), heap_.end(), Later{});
      advance();
    }
    if (hasContact()) settle();
    return best_ ? *best_ : PairContact{clearContact(query_.one.link)};
  }

  std::optional<PairContact> runAtStart() {
    if (!lookNearestFirst(0.0)) settleUnseen();
    return best_;
  }

  PairContact runAround(const PairContact& contact) {
    best_ = contact;
    lookAround();
    return *best_;
  }

 private:
  void startCandidates() {
    for (Candidate& candidate : heap_) {
      FORETOUCH_ASSERT(candidate.pieces != 0);
      candidate.freeUntil = nextPossible(query_.pieces, candidate, candidate.freeUntil);
    }
    std::make_heap(heap_.begin(), heap_.end(), Later{});
  }

  /// Tests the candidate (the heap's last, just popped) at its instant, and advances it, ends it,
  /// replaces it by the parts below, or takes it as the link's contact.
  void advance() {
    Candidate& candidate = heap_.back();
    const double t = candidate.freeUntil;
    const MovingPair pair = pairAt(candidate, t);
    const bool isSurface = query_.isSurface(candidate);
    if (pair.gapUpper <= query_.tolerance) {
      if (!isSurface) return descendFrom(pair, t);
      best_ = contactOf(query_, candidate, pair, t);
      heap_.pop_back();
      return;
    }
    const double reached = provenFrom(query_, candidate, pair, t, counters_);
    if (!(reached > t)) {
      if (!isSurface) return descendFrom(pair, t);
      giveUp(t, UndecidedReason::Resolution);
      heap_.pop_back();
      return;
    }
    candidate.freeUntil = nextPossible(query_.pieces, candidate, reached);
    candidate.nearest = -kInfinity;
    if (candidate.freeUntil <= horizon_ && candidate.freeUntil < 1.0) {
      std::push_heap(heap_.begin(), heap_.end(), Later{});
    } else {
      heap_.pop_back();
    }
  }

  /// From an instant on, replaces the heap's last candidate by the two parts below; the plane found
  /// for it advances them if it can.
  void descendFrom(const MovingPair& pair, double t) {
    descend(Later{}, [&](Candidate& part) {
      ++counters_.planeTests;
      const double step =
          stepByPlane(oneSideOf(query_, part, states_.at(t)),
                      otherSideOf(query_, part, states_.at(t)), pair.axes.nhat, query_.tolerance);
      if (step > 0.0) part.freeUntil = nextPossible(query_.pieces, part, timeAfter(t, step, 1.0));
    });
  }

  /// Replaces the heap's last candidate by the two parts below. `prepare` readies each for the
  /// heap's order.
  template <typename Order, typename Prepare>
  void descend(const Order& order, const Prepare& prepare) {
    const Candidate parent = heap_.back();
    heap_.pop_back();
    LinkQuery::Below below = query_.below(parent);
    for (std::size_t i = 0; i < below.count; ++i) {
      Candidate& child = below.candidates[i];
      prepare(child);
      if (!(child.freeUntil < 1.0) || child.freeUntil > horizon_) continue;
      heap_.push_back(child);
      std::push_heap(heap_.begin(), heap_.end(), order);
    }
  }

  [[nodiscard]] MovingPair pairAt(const Candidate& candidate, double t) {
    return pairOf(query_, candidate, states_.at(t), counters_);
  }

  [[nodiscard]] bool hasContact() const { return best_ && best_->verdict != Verdict::Undecided; }

  /// Chooses the contact to report at the instant of the first one found.
  void settle() {
    if (best_->toi == 0.0) {
      // Deeper pairs than the one found are not proven apart either, so they are in the heap.
      const auto others = std::remove_if(heap_.begin(), heap_.end(),
                                         [](const Candidate& c) { return c.freeUntil > 0.0; });
      heap_.erase(others, heap_.end());
      if (!lookNearestFirst(0.0)) return settleUnseen();
    }
    if (best_->verdict == Verdict::Contact) lookAround();
  }

  /// Pairs that moved on beyond the contact's instant, or were dropped, may be nearer at it. A
  /// spent budget ends the search: the verdict stands, with the best contact seen.
  void lookAround() {
    const double t = best_->toi;
    query_.neighbours.collect(t, states_.at(t), reachOf(*best_), heap_, counters_);
    (void)lookNearestFirst(t);
  }

  /// Finds the contact to report at `t`, if there is one. A limb deep in furniture touches
  /// thousands of triangles at once and the smallest separation wins, so this tests the nearest
  /// boxes first, until the boxes alone show that no better one is left. False if a spent budget
  /// ended it.
  [[nodiscard]] bool lookNearestFirst(double t) {
    for (Candidate& candidate : heap_) {
      // The lanes' bounds are hardly below the truth; use boxes only where lanes have none.
      if (candidate.nearest == -kInfinity) {
        candidate.nearest = leastGap(query_, candidate, states_.at(t));
      }
    }
    // What is beyond reach stays so, as contacts that are found only bring it nearer.
    const auto isBeyond = [most = reach()](const Candidate& one) { return one.nearest > most; };
    heap_.erase(std::remove_if(heap_.begin(), heap_.end(), isBeyond), heap_.end());
    std::make_heap(heap_.begin(), heap_.end(), Farther{});
    while (!heap_.empty() && heap_.front().nearest <= reach()) {
      if (query_.meter.isPartSpent(counters_)) return false;
      std::pop_heap(heap_.begin(), heap_.end(), Farther{});
      if (isBest(heap_.back())) {
        heap_.pop_back();
        continue;
      }
      const MovingPair pair = pairAt(heap_.back(), t);
      if (pair.gapUpper <= query_.tolerance && !query_.isSurface(heap_.back())) {
        descend(Farther{}, [&](Candidate& part) {
          part.nearest = std::max(part.nearest, leastGap(query_, part, states_.at(t)));
        });
        continue;
      }
      if (pair.gapUpper <= query_.tolerance) {
        const PairContact contact = contactOf(query_, heap_.back(), pair, t);
        if (!hasContact() || comesFirst(contact, *best_)) best_ = contact;
      }
      heap_.pop_back();
    }
    return true;
  }

  /// Whether it is the pair of the best contact so far.
  [[nodiscard]] bool isBest(const Candidate& candidate) const {
    if (!hasContact() || candidate.otherLss != best_->otherLss ||
        otherTriangle(query_, candidate) != best_->triangle) {
      return false;
    }
    if (candidate.part.isTriangle()) return candidate.part.index() == best_->linkTriangle;
    return candidate.lss == best_->lss && query_.isSurface(candidate);
  }

  /// At t = 0 an unseen pair may be deeper than the contact found, so whether the link starts in
  /// contact is open.
  void settleUnseen() {
    if (!best_ || best_->verdict != Verdict::Contact) return;
    best_ = PairContact{undecidedContact(query_.one.link, 0.0, UndecidedReason::WorkBudget)};
  }

  /// A pair farther than this is not a contact, or not one to report.
  [[nodiscard]] double reach() const {
    return hasContact() ? best_->separation - best_->penetration : query_.tolerance;
  }

  void giveUp(double t, UndecidedReason reason) {
    if (best_) return;  // a contact at this instant stands
    best_ = PairContact{undecidedContact(query_.one.link, t, reason)};
    horizon_ = t;
  }

  const LinkQuery& query_;
  std::vector<Candidate>& heap_;
  QueryCounters& counters_;
  std::optional<PairContact> best_;  // nothing: clear so far
  double horizon_ = kInfinity;       // nothing later than this can change the answer
  StateCache states_;
};

}  // namespace

std::optional<LinkContact> contactAtStart(const LinkQuery& query,
                                          std::vector<Candidate>& candidates,
                                          QueryCounters& counters) {
  if (query.isExact()) return meshContactAtStart(query, candidates, nullptr, counters);
  return Backtracker(query, candidates, counters).runAtStart();
}

LinkContact nearestContact(const LinkQuery& query, const LinkContact& contact,
                           std::vector<Candidate>& candidates, QueryCounters& counters) {
  return Backtracker(query, candidates, counters).runAround(PairContact{contact});
}

PairContact backtrack(const LinkQuery& query, std::vector<Candidate>& candidates,
                      QueryCounters& counters) {
  return Backtracker(query, candidates, counters).run();
}

}  // namespace foretouch::internal
