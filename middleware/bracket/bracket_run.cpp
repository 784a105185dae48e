#include "middleware/bracket/bracket_run.h"

#include <algorithm>
#include <cmath>

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
constexpr double kStrayShare = 1.0 / 16.0, kStrayResolutions = 2.0;

/// Who is asked: a link and the scene, or two own links.
struct Asked {
  LinkId link, other = kNoParent;
};

/// One question.
class BracketRun {
 public:
  BracketRun(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
             StepBrackets& brackets)
      : plan_(plan), ask_(ask), memory_(memory), brackets_(brackets) {
    memory.bracketer = SideBracketer(plan.options.resolution);
  }

  void run() {
    sweep();
    findNear();
    for (LinkId link = 0; link < plan_.avatar.numLinks(); ++link) {
      if (memory_.growths[slotOf(link)]) bracketLink(link);
    }
    for (const OwnPair& pair : plan_.pairs) {
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
      piece.evaluator.statesAt(0.0, memory_.first);
      piece.evaluator.statesAt(1.0, memory_.last);
      for (LinkId link = 0; link < plan_.avatar.numLinks(); ++link) {
        if (memory_.growths[slotOf(link)]) sweepLink(piece, link);
      }
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

  void bracketPair(const OwnPair& pair) {
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

  /// By the base level first; what it leaves open, by a finer one.
  void bracketSides(const Asked& asked, LinkBracket& bracket) {
    bracketOn(base(), asked, bracket);
    if (!ask_.isRefined || bracket.verdict == BracketVerdict::Excluded) return;
    const bool isOpen = bracket.verdict == BracketVerdict::Possible ||
                        bracket.possibleFrom < bracket.certainFrom ||
                        bracket.certainUntil < bracket.possibleUntil;
    const int level = levelFor(asked);
    if (!isOpen || level <= memory_.base) return;
    cutLevel(level);
    bracketOn(memory_.levels[slotOf(level)], asked, bracket);
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
    const bool wasCertain = bracket.verdict == BracketVerdict::Certain;
    const double latest = isNew ? 1.0 : bracket.possibleUntil;
    SidesPair witness;
    const auto first = find(pieces, asked, {Body::Grown, Way::Forward},
                            isNew ? 0.0 : bracket.possibleFrom, latest, witness);
    if (!first) {
      bracket = excluded(bracket);
      return;
    }
    bracket.verdict = wasCertain ? BracketVerdict::Certain : BracketVerdict::Possible;
    bracket.possibleFrom = *first;
    if (asked.other == kNoParent && !witness.isNone()) bracket.triangle = witness.other.triangle;
    if (ask_.isAhead) return;
    const auto last = find(pieces, asked, {Body::Grown, Way::Backward}, latest, *first, witness);
    bracket.possibleUntil = last.value_or(latest);
    findCertain(pieces, asked, wasCertain, witness, bracket);
  }

  void findCertain(ModelPieces& pieces, const Asked& asked, bool wasCertain, SidesPair witness,
                   LinkBracket& bracket) {
    const auto from = find(pieces, asked, {Body::Shrunk, Way::Forward}, bracket.possibleFrom,
                           wasCertain ? bracket.certainFrom : bracket.possibleUntil, witness);
    if (!from && !wasCertain) return;
    if (!wasCertain) bracket.certainUntil = *from;
    bracket.verdict = BracketVerdict::Certain;
    bracket.certainFrom = from && wasCertain ? std::min(*from, bracket.certainFrom)
                                             : from.value_or(bracket.certainFrom);
    const auto until = find(pieces, asked, {Body::Shrunk, Way::Backward}, bracket.possibleUntil,
                            bracket.certainUntil, witness);
    bracket.certainUntil = std::max(bracket.certainUntil, until.value_or(0.0));
  }

  [[nodiscard]] static LinkBracket excluded(const LinkBracket& bracket) {
    LinkBracket none;
    none.link = bracket.link;
    none.other = bracket.other;
    none.verdict = BracketVerdict::Excluded;
    none.growth = bracket.growth;
    return none;
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
      const double at = std::clamp((from - piece.begin) / span, 0.0, 1.0);
      const auto t = memory_.bracketer.find(memory_.sides, growth, search, at, witness);
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
