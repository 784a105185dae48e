#include "middleware/pair/start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lss/rounding.h"

namespace foretouch::internal {
namespace {

/// Farther first, so that the heap's top is the nearest; by the triangles themselves where equal,
/// so that the order does not depend on their numbers.
class FartherStart {
 public:
  explicit FartherStart(const Scene& scene) : scene_(scene) {}
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
  StartSearch(const LinkQuery& query, std::vector<Candidate>& heap, PartScratch* lanes,
              QueryCounters& counters)
      : query_(query),
        heap_(heap),
        scratch_(lanes),
        counters_(counters),
        states_(query, counters),
        isFar_(floatAbove(query.tolerance)) {}

  std::optional<LinkContact> run() {
    const FartherStart farther(*query_.scene);
    // pieces == 0 marks a candidate whose `nearest` is no longer a bound but the LSS's own
    // separation: popped a second time, nothing that is left is deeper.
    boundAll();
    std::make_heap(heap_.begin(), heap_.end(), farther);
    while (!heap_.empty() && heap_.front().nearest <= query_.tolerance) {
      if (query_.meter.isPartSpent(counters_)) {
        return undecidedContact(query_.one.link, 0.0, UndecidedReason::WorkBudget);
      }
      std::pop_heap(heap_.begin(), heap_.end(), farther);
      Candidate candidate = heap_.back();
      heap_.pop_back();
      if (candidate.pieces != 0) {
        const MovingPair pair = look(candidate);
        if (pair.gapUpper > query_.tolerance) continue;
        candidate.nearest = pair.estimate();
        candidate.pieces = 0;
        heap_.push_back(candidate);
        std::push_heap(heap_.begin(), heap_.end(), farther);
      } else {
        searchBelow(candidate);
        if (best_ && best_->verdict == Verdict::StartsInContact) break;
      }
    }
    return best_;
  }

 private:
  MovingPair look(const Candidate& candidate) {
    return pairOf(query_, candidate, states_.at(0.0), counters_);
  }

  void boundAll() {
    if (scratch_ == nullptr) {
      for (Candidate& candidate : heap_) {
        candidate.nearest = leastGap(query_, candidate, states_.at(0.0));
      }
      return;
    }
    std::int32_t lss = -1;
    LanePart part{};
    for (std::size_t first = 0; first < heap_.size(); first += kTrianglePairLanes) {
      const std::size_t count = std::min(kTrianglePairLanes, heap_.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Candidate& candidate = heap_[first + lane];
        if (candidate.lss != lss) {  // they come LSS by LSS
          lss = candidate.lss;
          part = lanePart(query_.one.lssOf(lss, Part::whole()));
        }
        put(lane, candidate, part);
      }
      counters_.partSteps += count;
      scratch_->lanes.proveLss(count);
      for (std::size_t lane = 0; lane < count; ++lane) bound(heap_[first + lane], lane);
    }
  }

  /// A lower bound on the separation that doubles will find: theirs is farther from the truth by
  /// rounding, but never deeper than the radius.
  void bound(Candidate& candidate, std::size_t lane) const {
    const double radius = query_.one.lssOf(candidate.lss, Part::whole()).radius;
    const double lower = scratch_->lanes.lower(lane);
    candidate.nearest = std::max(-radius, lower - kDepthRounding * (1.0 + std::abs(lower)));
  }

  void put(std::size_t lane, const Candidate& candidate, const LanePart& part) {
    scratch_->lanes.put(lane, candidate.laneTriangle, part, scratch_->lanes.laneTime(0.0), 0.0F);
  }
  /// The link's triangles under one LSS against one triangle of the scene.
  void searchBelow(const Candidate& whole) {
    std::optional<LinkContact> touching;
    if (scratch_ == nullptr) {
      searchInDoubles(whole, touching);
    } else if (query_.one.surface->hasTriangles(whole.lss)) {
      searchInLanes(whole, touching);
    } else {
      take(contactOf(query_, whole, look(whole), 0.0), touching);
    }
    if (touching) best_ = touching;
  }

  void searchInDoubles(const Candidate& whole, std::optional<LinkContact>& touching) {
    stack_.assign(1, whole.part);
    while (!stack_.empty()) {
      Candidate candidate = whole;
      candidate.part = stack_.back();
      stack_.pop_back();
      const bool isSurface = query_.isSurface(candidate);
      if (isSurface || !candidate.part.isWhole()) {
        if (leastGap(query_, candidate, states_.at(0.0)) > query_.tolerance) continue;
        const MovingPair pair = look(candidate);
        if (pair.gapUpper > query_.tolerance) continue;
        if (isSurface) take(contactOf(query_, candidate, pair, 0.0), touching);
      }
      if (isSurface) continue;
      const std::array<Part, 2> parts = query_.one.below(candidate.lss, candidate.part);
      stack_.push_back(parts[0]);
      if (!(parts[1] == parts[0])) stack_.push_back(parts[1]);
    }
  }

  /// Tests the triangles that lanes leave, in doubles and in ascending order: the first that
  /// touches is the lowest.
  void searchInLanes(const Candidate& whole, std::optional<LinkContact>& touching) {
    refuteInLanes(whole);
    std::vector<std::int32_t>& left = scratch_->linkTriangles;
    std::sort(left.begin(), left.end());
    for (const std::int32_t triangle : left) {
      Candidate candidate = whole;
      candidate.part = Part::of(HierarchyChild::triangle(triangle));
      const MovingPair pair = look(candidate);
      if (pair.gapUpper > query_.tolerance) continue;
      take(contactOf(query_, candidate, pair, 0.0), touching);
      if (touching) return;
    }
  }

  /// Leaves in `linkTriangles` those below the LSS that lanes cannot prove farther than the
  /// tolerance.
  void refuteInLanes(const Candidate& whole) {
    scratch_->linkTriangles.clear();
    scratch_->parts.clear();
    const HierarchyChild root = query_.one.surface->root(whole.lss);
    if (root.isTriangle()) {
      scratch_->linkTriangles.push_back(root.index());
    } else {
      expand(whole.lss, root);
    }
    while (!scratch_->parts.empty()) {
      const std::size_t count = takeNodes();
      for (std::size_t lane = 0; lane < count; ++lane) {
        put(lane, whole, query_.one.surface->lanePart(whole.lss, batch_[lane]));
      }
      counters_.partSteps += count;
      scratch_->lanes.proveLss(count);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (!(scratch_->lanes.lower(lane) > isFar_)) expand(whole.lss, batch_[lane]);
      }
    }
    refuteTriangles(whole);
  }

  /// The stack's last nodes, as many as there are lanes, become the batch.
  std::size_t takeNodes() {
    std::vector<HierarchyChild>& stack = scratch_->parts;
    const std::size_t count = std::min(kTrianglePairLanes, stack.size());
    const auto first = stack.end() - static_cast<std::ptrdiff_t>(count);
    std::copy(first, stack.end(), batch_.begin());
    stack.erase(first, stack.end());
    return count;
  }

  void expand(std::int32_t lss, HierarchyChild node) {
    for (const HierarchyChild part : query_.one.surface->below(lss, node)) {
      if (part.isTriangle()) {
        scratch_->linkTriangles.push_back(part.index());
      } else {
        scratch_->parts.push_back(part);
      }
    }
  }

  void refuteTriangles(const Candidate& whole) {
    std::vector<std::int32_t>& triangles = scratch_->linkTriangles;
    std::size_t kept = 0;
    for (std::size_t first = 0; first < triangles.size(); first += kTrianglePairLanes) {
      const std::size_t count = std::min(kTrianglePairLanes, triangles.size() - first);
      for (std::size_t lane = 0; lane < count; ++lane) {
        const auto part = HierarchyChild::triangle(triangles[first + lane]);
        put(lane, whole, query_.one.surface->lanePart(whole.lss, part));
      }
      counters_.partSteps += count;
      scratch_->lanes.proveTriangles(count);
      for (std::size_t lane = 0; lane < count; ++lane) {
        if (!(scratch_->lanes.lower(lane) > isFar_)) triangles[kept++] = triangles[first + lane];
      }
    }
    triangles.resize(kept);
  }

  void take(const LinkContact& contact, std::optional<LinkContact>& touching) {
    if (contact.verdict == Verdict::StartsInContact) {
      if (!touching || contact.linkTriangle < touching->linkTriangle) touching = contact;
    } else if (!best_ || comesFirst(contact, *best_)) {
      best_ = contact;
    }
  }

  /// Thousands of roundings of what doubles compute.
  static constexpr double kDepthRounding = 1e-12;

  const LinkQuery& query_;
  std::vector<Candidate>& heap_;
  PartScratch* const scratch_;  // null: doubles only
  QueryCounters& counters_;
  StateCache states_;
  double isFar_;
  std::vector<Part> stack_;
  std::array<HierarchyChild, kTrianglePairLanes> batch_ = nobody();
  std::optional<LinkContact> best_;

  static std::array<HierarchyChild, kTrianglePairLanes> nobody() {
    const HierarchyChild none = HierarchyChild::node(0);
    return {none, none, none, none, none, none, none, none,
            none, none, none, none, none, none, none, none};
  }
};

}  // namespace

std::optional<LinkContact> meshContactAtStart(const LinkQuery& query,
                                              std::vector<Candidate>& candidates,
                                              PartScratch* lanes, QueryCounters& counters) {
  if (lanes != nullptr) query.one.surface->prepare();
  return StartSearch(query, candidates, lanes, counters).run();
}

}  // namespace foretouch::internal
