#include "middleware/bracket/bracket_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lss/rounding.h"
#include "middleware/bracket/model_levels.h"
#include "middleware/bracket/step_sweep.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using Body = BracketSearch::Body;
using Way = BracketSearch::Way;

/// A passage is looked for in so many parts of a step, or more: it is known to such a part.
constexpr int kWayParts = 16;

/// One question.
class BracketRun : private StepSweep {
 public:
  BracketRun(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
             StepBrackets& brackets)
      : StepSweep(plan, ask, memory), brackets_(brackets) {}

  void run() {
    begin();
    brackets_.pieces = base(0).count();
    if (plan_.scene) {
      for (LinkId link = 0; link < numLinks(0); ++link) {
        if (isClaimed(0, link)) bracketLink(link);
      }
    }
    forEachPair([this](const Asked& asked) { bracketPair(asked); });
    brackets_.looks = memory_.sides.looks;
    brackets_.work = memory_.sides.work;
    brackets_.isSpent = memory_.sides.isSpent();
  }

 private:
  void bracketLink(LinkId link) {
    LinkBracket& bracket = brackets_.links[slotOf(link)];
    bracket.verdict = BracketVerdict::Excluded;
    bracket.growth = memory_.bodies[0].most[slotOf(link)];
    if (memory_.isNear[slotOf(link)] == 0) return;
    if (memory_.ignored.collect(plan_.ignored, link)) return;
    bracketSides({link}, bracket);
  }

  void bracketPair(const Asked& asked) {
    const BodyBrackets &one = memory_.bodies[0], &other = memory_.bodies[asked.otherBody];
    if (lssOf(0, asked.link).empty() || lssOf(asked.otherBody, asked.other).empty()) return;
    LinkBracket bracket;
    bracket.link = asked.link;
    bracket.other = asked.other;
    if (isClaimed(0, asked.link) && isClaimed(asked.otherBody, asked.other)) {
      if (!mayMeet(asked)) return;
      bracket.verdict = BracketVerdict::Excluded;
      bracket.growth = one.most[slotOf(asked.link)] + other.most[slotOf(asked.other)];
      bracketSides(asked, bracket);
    }
    if (bracket.verdict != BracketVerdict::Excluded) brackets_.pairs.push_back(bracket);
  }

  /// Asks the base level first, which excludes most, and closes on what is touched throughout; then
  /// the level that is fine enough for what it leaves open.
  void bracketSides(const Asked& asked, LinkBracket& bracket) {
    if (memory_.sides.isSpent()) {
      bracket.verdict = BracketVerdict::Possible;
      return;
    }
    limit(bracket.growth, asked);
    const int level = ask_.isRefined ? levelFor(asked) : memory_.base;
    bracketOn(memory_.base, asked, level == memory_.base, bracket);
    const bool isClosed = bracket.verdict == BracketVerdict::Excluded ||
                          (bracket.verdict == BracketVerdict::Certain &&
                           bracket.certainFrom <= bracket.possibleFrom &&
                           bracket.certainUntil >= bracket.possibleUntil);
    if (memory_.sides.isSpent()) return;
    if (level > memory_.base && !isClosed) {
      for (const std::size_t body : {std::size_t{0}, asked.otherBody}) {
        cutLevel(plan_, body, level, memory_);
      }
      brackets_.pieces = std::max(brackets_.pieces, 1 << level);
      bracketOn(level, asked, true, bracket);
    }
    if (asked.other == kNoParent) findPassage(isClosed ? memory_.base : level, bracket);
  }

  /// Whether its triangles are listed by leaves, piece by piece.
  [[nodiscard]] bool isListed(const Asked& asked) const {
    return asked.other == kNoParent && areLssSurface();
  }

  void limit(double growth, const Asked& asked) {
    const auto count = countOf(base(0).count());
    memory_.near.resize(std::max(memory_.near.size(), count));
    memory_.leaves.resize(memory_.near.size());
    memory_.areLeavesKnown.assign(count, 0);
    memory_.arePairsKnown.assign(count, 0);
    memory_.arePiecesWalked = false;
    memory_.isLimited = !isListed(asked) && growth <= kSmallGrowth;
    if (!memory_.isLimited) return;
    for (std::size_t k = 0; k < count; ++k) {
      memory_.sides.grow(setSides(memory_.base, static_cast<int>(k), asked), 1.0);
      memory_.sides.collect(0.0, 1.0, plan_.resolution, memory_.near[k]);
    }
  }

  [[nodiscard]] int levelFor(const Asked& asked) {
    const int level = internal::levelFor(plan_, 0, asked.link, memory_);
    if (asked.other == kNoParent) return level;
    return std::max(level, internal::levelFor(plan_, asked.otherBody, asked.other, memory_));
  }

  /// The sides in a piece, and by how much they grow in it.
  [[nodiscard]] Growth setSides(int level, int k, const Asked& asked) {
    MovingSides& sides = memory_.sides;
    const BodyPlan &body = plan_.bodies[0], &otherBody = plan_.bodies[asked.otherBody];
    ModelPiece& piece = piecesOf(0, level).piece(k);
    const Growth growth = ask_.growths.of(piece, 0, asked.link);
    if (asked.other == kNoParent) {
      sides.begin(kNoParent);
      sides.setScene(*plan_.scene, kNoObject);
      sides.ignore(&memory_.ignored);
      sides.setLink(piece.evaluator, asked.link, body.shapeOf(asked.link));
      return growth;
    }
    const bool isOwn = asked.otherBody == 0;
    sides.begin(isOwn ? plan_.asked.frames()[slotOf(plan_.asked.frameOf(asked.link, asked.other))]
                      : kNoParent);
    sides.setLink(piece.evaluator, asked.link, body.shapeOf(asked.link));
    ModelPiece& otherPiece = piecesOf(asked.otherBody, level).piece(k);
    sides.setOther(otherPiece.evaluator, asked.other, otherBody.shapeOf(asked.other));
    if (isOwn) {
      sides.setShares(plan_.asked, body.table.first(asked.link), body.table.first(asked.other));
    }
    return growth + ask_.growths.of(otherPiece, asked.otherBody, asked.other);
  }

  /// What the bracket says already holds, and is made narrower. `isLast`: no finer level follows;
  /// else more than the first instant is of use only where it closes the bracket, as it may on what
  /// touches throughout.
  void bracketOn(int level, const Asked& asked, bool isLast, LinkBracket& bracket) {
    const bool isNew = bracket.verdict == BracketVerdict::Excluded;
    const double earliest = isNew ? 0.0 : bracket.possibleFrom;
    const double latest = isNew ? 1.0 : bracket.possibleUntil;
    SidesPair witness;
    const auto first = find(level, asked, {Body::Grown, Way::Forward}, earliest, latest, witness);
    if (!first) return exclude(bracket);
    if (isNew) bracket.verdict = BracketVerdict::Possible;
    bracket.possibleFrom = *first;
    if (asked.other == kNoParent && !witness.isNone()) bracket.triangle = witness.other.triangle;
    if (ask_.isAhead || (!isLast && bracket.possibleFrom > 0.0)) return;
    SidesPair inside = witness;
    const auto last = find(level, asked, {Body::Grown, Way::Backward}, latest, *first, witness);
    bracket.possibleUntil = last.value_or(latest);
    const bool isThroughout = bracket.possibleFrom <= 0.0 && bracket.possibleUntil >= 1.0;
    if (isLast || isThroughout) findCertain(level, asked, inside, bracket);
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

  void findCertain(int level, const Asked& asked, SidesPair inside, LinkBracket& bracket) {
    const bool isKnown = bracket.verdict == BracketVerdict::Certain;
    const auto from = find(level, asked, {Body::Shrunk, Way::Forward}, bracket.possibleFrom,
                           isKnown ? bracket.certainFrom : bracket.possibleUntil, inside);
    if (!from && !isKnown) return;
    bracket.certainUntil = std::max(isKnown ? bracket.certainUntil : 0.0, from.value_or(0.0));
    bracket.certainFrom = std::min(isKnown ? bracket.certainFrom : 1.0, from.value_or(1.0));
    bracket.verdict = BracketVerdict::Certain;
    const auto until = find(level, asked, {Body::Shrunk, Way::Backward}, bracket.possibleUntil,
                            bracket.certainUntil, inside);
    bracket.certainUntil = std::max(bracket.certainUntil, until.value_or(0.0));
  }

  /// For ends of axes that are thinner than their growth: the shrunk body says nothing of those.
  void findPassage(int level, LinkBracket& bracket) {
    const bool isOpen =
        bracket.verdict == BracketVerdict::Possible && bracket.possibleFrom < bracket.possibleUntil;
    if (!isOpen || ask_.isAhead || plan_.bodies[0].surface) return;
    for (const Lss& lss : lssOf(0, bracket.link)) {
      if (lss.radius >= bracket.growth) continue;
      for (const Vector3d& end : {lss.a, lss.b}) {
        setWay(level, bracket, end);
        const auto passed = memory_.passage.find(*plan_.scene, memory_.ignored, memory_.way);
        if (!passed) continue;
        const bool isFirst = bracket.verdict == BracketVerdict::Possible;
        bracket.verdict = BracketVerdict::Certain;
        if (!isFirst && passed->by >= bracket.certainFrom) continue;
        bracket.certainFrom = passed->by;
        bracket.certainUntil = passed->after;
      }
    }
  }

  /// Sets the way of a point of the link, while it may touch something.
  void setWay(int level, const LinkBracket& bracket, const Vector3d& p_L) {
    std::vector<PassagePart>& way = memory_.way;
    way.clear();
    ModelPieces& pieces = piecesOf(0, level);
    const int count = std::max(kWayParts, pieces.count());
    double begin = bracket.possibleFrom;
    for (int i = 1; i <= count; ++i) {
      const double end = std::min(static_cast<double>(i) / count, bracket.possibleUntil);
      if (end <= begin) continue;
      ModelPiece& piece = pieces.piece(pieces.at(0.5 * (begin + end)));
      PassagePart part = passagePart(piece, bracket.link, p_L, begin, end);
      if (!way.empty()) joinTo(way.back(), part);
      way.push_back(part);
      begin = end;
    }
  }

  /// Pieces meet to within rounding, which the radii hold; the halves of a gap stand apart.
  void joinTo(const PassagePart& last, PassagePart& part) {
    if (ask_.isContinuous) {
      part.from = last.to;
    } else if (last.to != part.from) {
      const double radius = std::max(last.radiusTo, part.radiusFrom);
      memory_.way.push_back({part.begin, part.begin, last.to, part.from, radius, radius, radius});
    }
  }

  [[nodiscard]] PassagePart passagePart(ModelPiece& piece, LinkId link, const Vector3d& p_L,
                                        double begin, double end) const {
    const auto localOf = [&](double t) {
      return std::clamp((t - piece.begin) / (piece.end - piece.begin), 0.0, 1.0);
    };
    const double from = localOf(begin), to = localOf(end);
    const Growth growth = ask_.growths.of(piece, 0, link);
    const AxisBounds bounds = axisBounds({p_L, p_L, 0.0}, piece.motion.bounds(link));
    // Pieces meet to within rounding, and so do instants of both.
    const double rounding = 4.0 * bounds.positionRoundingA;
    const double sagitta = bounds.accelerationA * (to - from) * (to - from) / 8.0;
    return {begin,
            end,
            piece.evaluator.stateAt(link, from).pointAt(p_L),
            piece.evaluator.stateAt(link, to).pointAt(p_L),
            growth.mostIn(from, to) + sagitta + rounding,
            growth.at(from) + rounding,
            growth.at(to) + rounding};
  }

  /// The first instant that the search finds from `from` to `to` of the step, which is before it on
  /// the way back; perhaps one of the same piece beyond `to`.
  [[nodiscard]] std::optional<double> find(int level, const Asked& asked,
                                           const BracketSearch& search, double from, double to,
                                           SidesPair& witness) {
    const ModelPieces& pieces = piecesOf(0, level);
    const int step = search.way == Way::Forward ? 1 : -1;
    for (int k = pieces.at(from); k * step <= pieces.at(to) * step; k += step) {
      const ModelPiece& piece = piecesOf(0, level).piece(k);
      const double span = piece.end - piece.begin;
      const double at = std::clamp((from - piece.begin) / span, 0.0, 1.0);
      const auto t = isListed(asked) ? findListed(level, k, asked, search, at, witness)
                                     : findIn(level, k, asked, search, at, witness);
      if (t) return std::clamp(piece.begin + *t * span, 0.0, 1.0);
    }
    return std::nullopt;
  }

  [[nodiscard]] int basePieceOf(int level, int k) {
    return k * base(0).count() / piecesOf(0, level).count();
  }

  /// The same from `from` of a piece to its end.
  [[nodiscard]] std::optional<double> findIn(int level, int k, const Asked& asked,
                                             const BracketSearch& search, double from,
                                             SidesPair& witness) {
    const Growth growth = setSides(level, k, asked);
    if (memory_.isLimited) memory_.sides.limitTo(memory_.near[slotOf(basePieceOf(level, k))]);
    return memory_.bracketer.find(memory_.sides, growth, plan_.resolution, search, from,
                                  search.way == Way::Forward ? 1.0 : 0.0, witness);
  }

  [[nodiscard]] std::optional<double> findListed(int level, int k, const Asked& asked,
                                                 const BracketSearch& search, double from,
                                                 SidesPair& witness) {
    const Growth growth = setSides(level, k, asked);
    const LinkInPiece piece{*plan_.scene,
                            memory_.ignored,
                            lssOf(0, asked.link),
                            asked.link,
                            piecesOf(0, level).piece(k).evaluator,
                            growth,
                            plan_.resolution,
                            memory_.sides};
    // For a link among many triangles, none is listed before it is known that it takes lists.
    if (isCrowded(asked.link) && isFoundAt(piece, search, from, nullptr, witness)) return from;
    const int basePiece = basePieceOf(level, k);
    const NearPairs* const pairs = pairsIn(basePiece, asked.link);
    if (pairs != nullptr && pairs->size() <= LeafSearch::kFewPairs) {
      if (pairs->empty()) return std::nullopt;
      memory_.sides.limitTo(*pairs, level == memory_.base);
      return memory_.bracketer.find(memory_.sides, growth, plan_.resolution, search, from,
                                    search.way == Way::Forward ? 1.0 : 0.0, witness);
    }
    const NearLeaves* const leaves = leavesIn(basePiece, asked.link);
    if (!isCrowded(asked.link) && isFoundAt(piece, search, from, leaves, witness)) return from;
    return memory_.search.find(piece, search, from, leaves, witness);
  }

  [[nodiscard]] bool isFoundAt(const LinkInPiece& piece, const BracketSearch& search, double at,
                               const NearLeaves* leaves, SidesPair& witness) {
    if (!witness.isNone() && SideBracketer::isFound(memory_.sides, piece.growth, plan_.resolution,
                                                    search, at, witness)) {
      return true;
    }
    return memory_.search.isFound(piece, search, at, leaves, witness);
  }

  StepBrackets& brackets_;
};

}  // namespace

void bracketLinks(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
                  StepBrackets& brackets) {
  BracketRun(plan, ask, memory, brackets).run();
}

}  // namespace foretouch::internal
