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

/// A passage is looked for in so many parts of a step, or more: it is known to such a part.
constexpr int kWayParts = 16;

/// Who is asked: a link of the first body and the scene, or a link of either body.
struct Asked {
  LinkId link, other = kNoParent;
  std::size_t otherBody = 0;
};

/// One question.
class BracketRun {
 public:
  BracketRun(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
             StepBrackets& brackets)
      : plan_(plan), ask_(ask), memory_(memory), brackets_(brackets) {}

  void run() {
    for (std::size_t body = 0; body < plan_.bodies.size(); ++body) sweep(body);
    brackets_.pieces = base(0).count();
    if (plan_.scene) {
      findNear();
      for (LinkId link = 0; link < numLinks(0); ++link) {
        if (isClaimed(0, link)) bracketLink(link);
      }
    }
    for (const foretouch::LinkPair& pair : plan_.pairs) bracketPair({pair.a, pair.b, 0});
    if (plan_.bodies.size() > 1) {
      for (LinkId link = 0; link < numLinks(0); ++link) {
        for (LinkId other = 0; other < numLinks(1); ++other) bracketPair({link, other, 1});
      }
    }
    brackets_.looks = memory_.sides.looks;
  }

 private:
  [[nodiscard]] ModelPieces& piecesOf(std::size_t body, int level) {
    return memory_.bodies[body].levels[slotOf(level)];
  }
  [[nodiscard]] ModelPieces& base(std::size_t body) { return piecesOf(body, memory_.base); }
  [[nodiscard]] LinkId numLinks(std::size_t body) const {
    return plan_.bodies[body].avatar.numLinks();
  }
  [[nodiscard]] const std::vector<Lss>& lssOf(std::size_t body, LinkId link) const {
    return plan_.bodies[body].avatar.lss(link);
  }
  [[nodiscard]] bool isClaimed(std::size_t body, LinkId link) const {
    return memory_.bodies[body].growths[slotOf(link)].has_value();
  }

  /// The box of what each link may sweep.
  void sweep(std::size_t body) {
    BodyBrackets& own = memory_.bodies[body];
    own.boxes.assign(countOf(numLinks(body)), Aabb{});
    const auto isKnown = [](const std::optional<StepGrowth>& growth) { return growth.has_value(); };
    if (std::none_of(own.growths.begin(), own.growths.end(), isKnown)) return;
    for (int k = 0; k < base(body).count(); ++k) {
      ModelPiece& piece = base(body).piece(k);
      // A piece begins where the one before it ends.
      if (k == 0 || !ask_.isContinuous) piece.evaluator.statesAt(0.0, own.first);
      piece.evaluator.statesAt(1.0, own.last);
      for (LinkId link = 0; link < numLinks(body); ++link) {
        if (isClaimed(body, link)) sweepLink(piece, body, link);
      }
      std::swap(own.first, own.last);
    }
  }

  void sweepLink(const ModelPiece& piece, std::size_t body, LinkId link) {
    BodyBrackets& own = memory_.bodies[body];
    const auto i = slotOf(link);
    const MotionBounds bounds = piece.motion.bounds(link);
    const double margin = ask_.growths.of(piece, body, link).most() * kInflation + plan_.resolution;
    // What would bound nothing at these coordinates.
    if (!(margin <= kMaxCoordinate)) return own.growths[i].reset();
    for (const Lss& lss : lssOf(body, link)) {
      own.boxes[i].add(sweptBox(lss, axisBounds(lss, bounds), axisEnds(lss, own.first[i]),
                                axisEnds(lss, own.last[i]), 1.0, margin));
    }
  }

  /// One walk of the scene's tree for all links.
  void findNear() {
    const auto count = countOf(numLinks(0));
    const SceneParts& scene = plan_.scene->parts();
    memory_.isNear.assign(count, 0);
    memory_.lanes.resize(numLinks(0));
    BoxLanes lanes;
    lanes.count = numLinks(0);
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t link = 0; link < count; ++link) {
        const Aabb& box = memory_.bodies[0].boxes[link];
        memory_.lanes.lower[axis][link] = floatBelow(box.min[axis] - scene.origin[axis]);
        memory_.lanes.upper[axis][link] = floatAbove(box.max[axis] - scene.origin[axis]);
      }
      lanes.lower[axis] = memory_.lanes.lower[axis];
      lanes.upper[axis] = memory_.lanes.upper[axis];
    }
    memory_.hits.clear();
    std::uint64_t nodes = 0, leaves = 0;
    scene.bvh.collectLeaves(lanes, memory_.hits, nodes, leaves);
    for (const LeafHit& hit : memory_.hits) memory_.isNear[hit.box] = 1;
  }

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
      if (!one.boxes[slotOf(asked.link)].overlaps(other.boxes[slotOf(asked.other)])) return;
      bracket.verdict = BracketVerdict::Excluded;
      bracket.growth = one.most[slotOf(asked.link)] + other.most[slotOf(asked.other)];
      bracketSides(asked, bracket);
    }
    if (bracket.verdict != BracketVerdict::Excluded) brackets_.pairs.push_back(bracket);
  }

  /// By the base level first, which excludes most, and closes on what is touched throughout; what
  /// it leaves open, by the level that is fine enough.
  void bracketSides(const Asked& asked, LinkBracket& bracket) {
    limitIfSmall(bracket.growth, asked);
    bracketOn(memory_.base, asked, bracket);
    const bool isClosed = bracket.verdict == BracketVerdict::Excluded ||
                          (bracket.verdict == BracketVerdict::Certain &&
                           bracket.certainFrom <= bracket.possibleFrom &&
                           bracket.certainUntil >= bracket.possibleUntil);
    const int level = ask_.isRefined && !isClosed ? levelFor(asked) : memory_.base;
    if (level > memory_.base) {
      for (const std::size_t body : {std::size_t{0}, asked.otherBody}) cutLevel(body, level);
      bracketOn(level, asked, bracket);
    }
    if (asked.other == kNoParent) findPassage(std::max(level, memory_.base), bracket);
  }

  void limitIfSmall(double growth, const Asked& asked) {
    memory_.isLimited = growth <= kSmallGrowth;
    if (!memory_.isLimited) return;
    const int count = base(0).count();
    memory_.near.resize(std::max(memory_.near.size(), countOf(count)));
    for (int k = 0; k < count; ++k) {
      memory_.sides.grow(setSides(memory_.base, k, asked), 1.0);
      memory_.sides.collect(0.0, 1.0, plan_.resolution, memory_.near[slotOf(k)]);
    }
  }

  void cutLevel(std::size_t body, int level) {
    BodyBrackets& own = memory_.bodies[body];
    if (own.isCut[slotOf(level)] != 0) return;
    piecesOf(body, level)
        .cut(plan_.bodies[body].avatar.skeleton(), own.part, own.model, 1 << level);
    own.isCut[slotOf(level)] = 1;
    brackets_.pieces = std::max(brackets_.pieces, 1 << level);
  }

  [[nodiscard]] int levelFor(const Asked& asked) {
    const int level = levelFor(0, asked.link);
    return asked.other == kNoParent ? level
                                    : std::max(level, levelFor(asked.otherBody, asked.other));
  }
  /// Halving a piece quarters what it strays.
  [[nodiscard]] int levelFor(std::size_t body, LinkId link) {
    const auto i = slotOf(link);
    double stray = 0.0;
    for (int k = 0; k < base(body).count(); ++k) {
      stray = std::max(stray, base(body).piece(k).strays[i].at(plan_.bodies[body].rho[i]));
    }
    const double allowed = std::max(kStrayShare * memory_.bodies[body].growths[i]->most,
                                    kStrayResolutions * plan_.resolution);
    int level = memory_.base;
    for (; stray > allowed && level + 1 < BodyBrackets::kLevels; ++level) stray *= 0.25;
    return level;
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

  /// What the bracket says already holds, and is made narrower.
  void bracketOn(int level, const Asked& asked, LinkBracket& bracket) {
    const bool isNew = bracket.verdict == BracketVerdict::Excluded;
    const double earliest = isNew ? 0.0 : bracket.possibleFrom;
    const double latest = isNew ? 1.0 : bracket.possibleUntil;
    SidesPair witness;
    const auto first = find(level, asked, {Body::Grown, Way::Forward}, earliest, latest, witness);
    if (!first) return exclude(bracket);
    if (isNew) bracket.verdict = BracketVerdict::Possible;
    bracket.possibleFrom = *first;
    if (asked.other == kNoParent && !witness.isNone()) bracket.triangle = witness.other.triangle;
    if (ask_.isAhead) return;
    SidesPair inside = witness;
    const auto last = find(level, asked, {Body::Grown, Way::Backward}, latest, *first, witness);
    bracket.possibleUntil = last.value_or(latest);
    findCertain(level, asked, inside, bracket);
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

  /// Of ends of axes that are thinner than their growth: the shrunk body says nothing of those.
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

  /// Of a point of the link, while it may touch something.
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
      const Growth growth = setSides(level, k, asked);
      if (memory_.isLimited) {
        memory_.sides.limitTo(memory_.near[slotOf(k * base(0).count() / pieces.count())]);
      }
      const double at = std::clamp((from - piece.begin) / span, 0.0, 1.0);
      const auto t =
          memory_.bracketer.find(memory_.sides, growth, plan_.resolution, search, at, witness);
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

void BodyBrackets::begin(std::size_t numLinks) {
  growths.assign(numLinks, std::nullopt);
  most.assign(numLinks, 0.0);
  isCut = {};
}

BodyPlan BodyPlan::of(const Avatar& avatar, const std::optional<AvatarSurface>& surface) {
  BodyPlan body{avatar, surface, LssTable(avatar), {}};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    double rho = 0.0;
    for (const Lss& lss : avatar.lss(link)) {
      rho = std::max(rho, std::max(lss.a.norm(), lss.b.norm()) + (surface ? lss.radius : 0.0));
    }
    body.rho.push_back(rho * kInflation);
  }
  return body;
}

void bracketLinks(const BracketPlan& plan, const BracketAsk& ask, BracketMemory& memory,
                  StepBrackets& brackets) {
  BracketRun(plan, ask, memory, brackets).run();
}

}  // namespace foretouch::internal
