#include "middleware/bracket/bracket_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lss/rounding.h"
#include "middleware/scene/scene_parts.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using Body = BracketSearch::Body;
using Way = BracketSearch::Way;

/// Pieces stray from the model by about this share of what the person may, or by so many
/// resolutions: more of them cost more than they bring.
constexpr double kStrayShare = 1.0 / 3.0, kStrayResolutions = 2.0;

/// Up to here (m) all that is near in a step is collected once.
constexpr double kSmallGrowth = 5e-3;

/// Who is asked: a link and the scene, or two own links.
struct Asked {
  LinkId link, other = kNoParent;
};

/// One question.
class BracketRun {
 public:
  BracketRun(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
             StepBrackets& brackets)
      : plan_(plan), ask_(ask), memory_(memory), brackets_(brackets) {}

  void run() {
    sweep();
    findNear();
    for (LinkId link = 0; link < plan_.avatar.numLinks(); ++link) {
      if (memory_.growths[slotOf(link)]) bracketLink(link);
    }
    for (const foretouch::LinkPair& pair : plan_.pairs) {
      if (memory_.growths[slotOf(pair.a)] && memory_.growths[slotOf(pair.b)]) bracketPair(pair);
    }
    brackets_.looks = memory_.sides.looks;
  }

 private:
  [[nodiscard]] ModelPieces& base() { return memory_.levels[slotOf(memory_.base)]; }

  /// The box of what each link may sweep.
  void sweep() {
    memory_.boxes.assign(countOf(plan_.avatar.numLinks()), Aabb{});
    for (int k = 0; k < base().count(); ++k) {
      ModelPiece& piece = base().piece(k);
      // A piece begins where the one before it ends.
      if (k == 0 || !ask_.isContinuous) piece.evaluator.statesAt(0.0, memory_.first);
      piece.evaluator.statesAt(1.0, memory_.last);
      for (LinkId link = 0; link < plan_.avatar.numLinks(); ++link) {
        if (memory_.growths[slotOf(link)]) sweepLink(piece, link);
      }
      std::swap(memory_.first, memory_.last);
    }
    brackets_.pieces = base().count();
  }

  void sweepLink(const ModelPiece& piece, LinkId link) {
    const MotionBounds bounds = piece.motion.bounds(link);
    const double margin =
        ask_.growths.of(piece, link).most() * kInflation + plan_.options.resolution;
    // What would bound nothing at these coordinates.
    if (!(margin <= kMaxCoordinate)) return memory_.growths[slotOf(link)].reset();
    for (const Lss& lss : plan_.avatar.lss(link)) {
      memory_.boxes[slotOf(link)].add(
          sweptBox(lss, axisBounds(lss, bounds), axisEnds(lss, memory_.first[slotOf(link)]),
                   axisEnds(lss, memory_.last[slotOf(link)]), 1.0, margin));
    }
  }

  /// One walk of the scene's tree for all links.
  void findNear() {
    const auto numLinks = countOf(plan_.avatar.numLinks());
    memory_.isNear.assign(numLinks, 0);
    memory_.lanes.resize(plan_.avatar.numLinks());
    BoxLanes lanes;
    lanes.count = plan_.avatar.numLinks();
    const Vector3d& origin = plan_.scene.parts().origin;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t link = 0; link < numLinks; ++link) {
        const Aabb& box = memory_.boxes[link];
        memory_.lanes.lower[axis][link] = floatBelow(box.min[axis] - origin[axis]);
        memory_.lanes.upper[axis][link] = floatAbove(box.max[axis] - origin[axis]);
      }
      lanes.lower[axis] = memory_.lanes.lower[axis];
      lanes.upper[axis] = memory_.lanes.upper[axis];
    }
    memory_.hits.clear();
    std::uint64_t nodes = 0, leaves = 0;
    plan_.scene.parts().bvh.collectLeaves(lanes, memory_.hits, nodes, leaves);
    for (const LeafHit& hit : memory_.hits) memory_.isNear[hit.box] = 1;
  }

  void bracketLink(LinkId link) {
    LinkBracket& bracket = brackets_.links[slotOf(link)];
    bracket.verdict = BracketVerdict::Excluded;
    bracket.growth = memory_.most[slotOf(link)];
    if (memory_.isNear[slotOf(link)] == 0) return;
    if (memory_.ignored.collect(plan_.options.ignored, link)) return;
    bracketSides({link}, bracket);
  }

  void bracketPair(const foretouch::LinkPair& pair) {
    const auto a = slotOf(pair.a), b = slotOf(pair.b);
    if (!memory_.boxes[a].overlaps(memory_.boxes[b])) return;
    LinkBracket bracket;
    bracket.link = pair.a;
    bracket.other = pair.b;
    bracket.verdict = BracketVerdict::Excluded;
    bracket.growth = memory_.most[a] + memory_.most[b];
    bracketSides({pair.a, pair.b}, bracket);
    if (bracket.verdict != BracketVerdict::Excluded) brackets_.pairs.push_back(bracket);
  }

  /// By the base level first, which excludes most, and closes on what is touched throughout; what
  /// it leaves open, by the level that is fine enough.
  void bracketSides(const Asked& asked, LinkBracket& bracket) {
    limitIfSmall(bracket.growth, asked);
    bracketOn(base(), asked, bracket);
    const bool isClosed = bracket.verdict == BracketVerdict::Excluded ||
                          (bracket.verdict == BracketVerdict::Certain &&
                           bracket.certainFrom <= bracket.possibleFrom &&
                           bracket.certainUntil >= bracket.possibleUntil);
    const int level = ask_.isRefined && !isClosed ? levelFor(asked) : memory_.base;
    if (level <= memory_.base) return;
    cutLevel(level);
    bracketOn(memory_.levels[slotOf(level)], asked, bracket);
  }

  void limitIfSmall(double growth, const Asked& asked) {
    memory_.isLimited = growth <= kSmallGrowth;
    if (!memory_.isLimited) return;
    memory_.near.resize(std::max(memory_.near.size(), countOf(base().count())));
    for (int k = 0; k < base().count(); ++k) {
      memory_.sides.grow(setSides(base().piece(k), asked), 1.0);
      memory_.sides.collect(0.0, 1.0, plan_.options.resolution, memory_.near[slotOf(k)]);
    }
  }

  void cutLevel(int level) {
    if (memory_.isCut[slotOf(level)] != 0) return;
    (void)memory_.levels[slotOf(level)].cut(plan_.avatar.skeleton(), ask_.step, memory_.model,
                                            1 << level);
    memory_.isCut[slotOf(level)] = 1;
    brackets_.pieces = std::max(brackets_.pieces, 1 << level);
  }

  /// Halving a piece quarters what it strays.
  [[nodiscard]] int levelFor(const Asked& asked) {
    int level = memory_.base;
    for (const LinkId link : {asked.link, asked.other}) {
      if (link == kNoParent) continue;
      double stray = 0.0;
      for (int k = 0; k < base().count(); ++k) {
        stray = std::max(stray, base().piece(k).strays[slotOf(link)].at(plan_.rho[slotOf(link)]));
      }
      const double allowed = std::max(kStrayShare * memory_.growths[slotOf(link)]->most,
                                      kStrayResolutions * plan_.options.resolution);
      int own = memory_.base;
      for (; stray > allowed && own + 1 < BracketMemory::kLevels; ++own) stray *= 0.25;
      level = std::max(level, own);
    }
    return level;
  }

  /// The sides in a piece, and by how much they grow in it.
  [[nodiscard]] Growth setSides(ModelPiece& piece, const Asked& asked) {
    MovingSides& sides = memory_.sides;
    const Growth growth = ask_.growths.of(piece, asked.link);
    if (asked.other == kNoParent) {
      sides.begin(kNoParent);
      sides.setScene(plan_.scene, kNoObject);
      sides.ignore(&memory_.ignored);
      sides.setLink(piece.evaluator, asked.link, plan_.shapeOf(asked.link));
      return growth;
    }
    sides.begin(plan_.asked.frames()[slotOf(plan_.asked.frameOf(asked.link, asked.other))]);
    sides.setLink(piece.evaluator, asked.link, plan_.shapeOf(asked.link));
    sides.setOther(piece.evaluator, asked.other, plan_.shapeOf(asked.other));
    sides.setShares(plan_.asked, plan_.table.first(asked.link), plan_.table.first(asked.other));
    return growth + ask_.growths.of(piece, asked.other);
  }

  /// What the bracket says already holds, and is made narrower.
  void bracketOn(ModelPieces& pieces, const Asked& asked, LinkBracket& bracket) {
    const bool isNew = bracket.verdict == BracketVerdict::Excluded;
    const double earliest = isNew ? 0.0 : bracket.possibleFrom;
    const double latest = isNew ? 1.0 : bracket.possibleUntil;
    SidesPair witness;
    const auto first = find(pieces, asked, {Body::Grown, Way::Forward}, earliest, latest, witness);
    if (!first) return exclude(bracket);
    if (isNew) bracket.verdict = BracketVerdict::Possible;
    bracket.possibleFrom = *first;
    if (asked.other == kNoParent && !witness.isNone()) bracket.triangle = witness.other.triangle;
    if (ask_.isAhead) return;
    SidesPair inside = witness;
    const auto last = find(pieces, asked, {Body::Grown, Way::Backward}, latest, *first, witness);
    bracket.possibleUntil = last.value_or(latest);
    findCertain(pieces, asked, inside, bracket);
  }

  /// Nothing is found; where a coarser level was certain, that holds.
  static void exclude(LinkBracket& bracket) {
    if (bracket.verdict != BracketVerdict::Possible) return;
    const LinkBracket fresh;
    bracket.verdict = BracketVerdict::Excluded;
    bracket.possibleFrom = fresh.possibleFrom;
    bracket.possibleUntil = fresh.possibleUntil;
    bracket.triangle = fresh.triangle;
  }

  void findCertain(ModelPieces& pieces, const Asked& asked, SidesPair inside,
                   LinkBracket& bracket) {
    const bool isKnown = bracket.verdict == BracketVerdict::Certain;
    const auto from = find(pieces, asked, {Body::Shrunk, Way::Forward}, bracket.possibleFrom,
                           isKnown ? bracket.certainFrom : bracket.possibleUntil, inside);
    if (!from && !isKnown) return;
    bracket.certainUntil = std::max(isKnown ? bracket.certainUntil : 0.0, from.value_or(0.0));
    bracket.certainFrom = std::min(isKnown ? bracket.certainFrom : 1.0, from.value_or(1.0));
    bracket.verdict = BracketVerdict::Certain;
    const auto until = find(pieces, asked, {Body::Shrunk, Way::Backward}, bracket.possibleUntil,
                            bracket.certainUntil, inside);
    bracket.certainUntil = std::max(bracket.certainUntil, until.value_or(0.0));
  }

  /// The first instant that the search finds from `from` to `to` of the step, which is before it on
  /// the way back; perhaps one of the same piece beyond `to`.
  [[nodiscard]] std::optional<double> find(ModelPieces& pieces, const Asked& asked,
                                           const BracketSearch& search, double from, double to,
                                           SidesPair& witness) {
    const int step = search.way == Way::Forward ? 1 : -1;
    for (int k = pieces.at(from); k * step <= pieces.at(to) * step; k += step) {
      ModelPiece& piece = pieces.piece(k);
      const double span = piece.end - piece.begin;
      const Growth growth = setSides(piece, asked);
      if (memory_.isLimited) {
        memory_.sides.limitTo(memory_.near[slotOf(k * base().count() / pieces.count())]);
      }
      const double at = std::clamp((from - piece.begin) / span, 0.0, 1.0);
      const auto t = memory_.bracketer.find(memory_.sides, growth, plan_.options.resolution, search,
                                            at, witness);
      if (t) return std::clamp(piece.begin + *t * span, 0.0, 1.0);
    }
    return std::nullopt;
  }

  const BracketPlan& plan_;
  const BracketAsk& ask_;
  BracketMemory& memory_;
  StepBrackets& brackets_;
};

}  // namespace

void bracketLinks(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
                  StepBrackets& brackets) {
  BracketRun(plan, ask, memory, brackets).run();
}

}  // namespace foretouch::internal
