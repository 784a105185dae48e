#include "middleware/exact/start.h"

#include <algorithm>
#include <array>
#include <optional>

namespace foretouch::internal {
namespace {

/// Farther first, so that the heap's top is the nearest; by the triangles themselves where equal,
/// so that the order does not depend on their numbers.
class Farther {
 public:
  explicit Farther(const Scene& scene) : scene_(scene) {}
  bool operator()(const Candidate& x, const Candidate& y) const {
    if (x.nearest != y.nearest) return x.nearest > y.nearest;
    const auto &v = scene_.triangle(x.triangle).vertices, &w = scene_.triangle(y.triangle).vertices;
    for (std::size_t i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        if (v[i][k] != w[i][k]) return v[i][k] > w[i][k];
      }
    }
    if (x.triangle != y.triangle) return x.triangle > y.triangle;
    return x.lss > y.lss;
  }

 private:
  const Scene& scene_;
};

class StartSearch {
 public:
  StartSearch(const LinkQuery& query, std::vector<Candidate>& heap, QueryCounters& counters)
      : query_(query), heap_(heap), counters_(counters), states_(query, counters) {}

  LinkContact run() {
    best_.link = query_.parts.link;
    const Farther farther(query_.scene);
    // pieces == 0 marks a candidate whose `nearest` is no longer a box's bound but the LSS's own
    // separation: popped a second time, nothing that is left is deeper.
    for (Candidate& candidate : heap_) {
      candidate.nearest = leastGap(query_, candidate, states_.at(0.0));
    }
    std::make_heap(heap_.begin(), heap_.end(), farther);
    while (!heap_.empty() && heap_.front().nearest <= query_.tolerance) {
      // Backtracking then says so, at t = 0. Once there is a contact the budget has no say.
      if (best_.verdict == Verdict::Clear && spent_ >= query_.maxAdvancements) break;
      std::pop_heap(heap_.begin(), heap_.end(), farther);
      Candidate candidate = heap_.back();
      heap_.pop_back();
      if (candidate.pieces != 0) {
        const PairState pair = look(candidate);
        if (pair.gapUpper > query_.tolerance) continue;
        candidate.nearest = pair.estimate();
        candidate.pieces = 0;
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), farther);
      } else {
        searchBelow(candidate);
        if (best_.verdict == Verdict::StartsInContact) break;
      }
    }
    return best_;
  }

 private:
  PairState look(const Candidate& candidate) {
    ++spent_;
    return pairOf(query_, candidate, states_.at(0.0), counters_);
  }

  /// The link's triangles under one LSS against one triangle of the scene.
  void searchBelow(const Candidate& whole) {
    std::optional<LinkContact> touching;
    stack_.assign(1, whole.part);
    while (!stack_.empty()) {
      Candidate candidate = whole;
      candidate.part = stack_.back();
      stack_.pop_back();
      const bool isSurface = query_.isSurface(candidate.lss, candidate.part);
      if (isSurface || !candidate.part.isWhole()) {
        if (leastGap(query_, candidate, states_.at(0.0)) > query_.tolerance) continue;
        const PairState pair = look(candidate);
        if (pair.gapUpper > query_.tolerance) continue;
        if (isSurface) take(contactOf(query_, candidate, pair, 0.0), touching);
      }
      if (isSurface) continue;
      const std::array<Part, 2> parts = query_.below(candidate.lss, candidate.part);
      stack_.push_back(parts[0]);
      if (!(parts[1] == parts[0])) stack_.push_back(parts[1]);
    }
    if (touching) best_ = *touching;
  }

  void take(const LinkContact& contact, std::optional<LinkContact>& touching) {
    if (contact.verdict == Verdict::StartsInContact) {
      if (!touching || contact.linkTriangle < touching->linkTriangle) touching = contact;
    } else if (best_.verdict == Verdict::Clear || comesFirst(contact, best_)) {
      best_ = contact;
    }
  }

  const LinkQuery& query_;
  std::vector<Candidate>& heap_;
  QueryCounters& counters_;
  StateCache states_;
  std::vector<Part> stack_;
  LinkContact best_;
  std::uint64_t spent_ = 0;
};

}  // namespace

LinkContact meshContactAtStart(const LinkQuery& query, std::vector<Candidate>& candidates,
                               QueryCounters& counters) {
  return StartSearch(query, candidates, counters).run();
}

}  // namespace foretouch::internal
