#include "middleware/events/moving_sides.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// Work as measured, roughly: a distance, two boxes, and what a tree of triangles takes.
constexpr std::uint64_t kLookWork = 40, kBoxWork = 4, kTreeWork = 50;

Part partOf(const SidePiece& piece) {
  return piece.triangle < 0 ? Part::whole() : Part::of(HierarchyChild::triangle(piece.triangle));
}

SidePiece pieceOf(std::int32_t lss, Part part) {
  return {lss, part.isTriangle() ? part.index() : -1};
}

/// Names a triangle without the LSS that holds it.
std::tuple<std::int32_t, std::int32_t> surfaceOf(const SidePiece& piece) {
  return {piece.triangle, piece.triangle < 0 ? piece.lss : -1};
}
bool areSameSurfaces(const SidesPair& x, const SidesPair& y) {
  return surfaceOf(x.one) == surfaceOf(y.one) && surfaceOf(x.other) == surfaceOf(y.other);
}
bool isBefore(const SidesPair& x, const SidesPair& y) {
  const auto key = [](const SidesPair& pair) {
    return std::make_tuple(surfaceOf(pair.one), surfaceOf(pair.other), pair.one.lss,
                           pair.other.lss);
  };
  return key(x) < key(y);
}

double extentOf(const Aabb& box) {
  return (box.max - box.min).sum();
}

}  // namespace

void MovingSides::begin(LinkId frame) {
  frame_ = frame;
  asked_ = nullptr;
  scene_ = nullptr;
  growthSign_ = 0.0;
  isBackward_ = false;
  limited_ = nullptr;
  states_.t = std::numeric_limits<double>::quiet_NaN();
}

MovingHull LinkSide::hullAt(const SidePiece& piece, const LinkState& state) const {
  return side().hullAt(piece.lss, partOf(piece), state);
}

void MovingSides::setSide(LinkSide& side, MotionEvaluator& evaluator, LinkId link,
                          const LinkShape& shape) {
  side.evaluator = &evaluator;
  side.link = link;
  side.lss = &shape.lss;
  side.surface = shape.surface;
  side.first = 0;
  side.frame = frame_;
  side.inFrame = evaluator.motion().sumsIn(frame_, link).bounds();
  side.bounds.clear();
  for (const Lss& one : shape.lss) side.bounds.push_back(axisBounds(one, side.inFrame));
  states_.t = std::numeric_limits<double>::quiet_NaN();
}

void MovingSides::setLink(MotionEvaluator& evaluator, LinkId link, const LinkShape& shape) {
  setSide(one_, evaluator, link, shape);
}

void MovingSides::setOther(MotionEvaluator& evaluator, LinkId link, const LinkShape& shape) {
  setSide(other_, evaluator, link, shape);
  scene_ = nullptr;
}

void MovingSides::setShares(const PairsAsked& asked, std::int32_t first,
                            std::int32_t firstOfOther) {
  asked_ = &asked;
  one_.first = first;
  other_.first = firstOfOther;
}

void MovingSides::setScene(const Scene& scene, ObjectId object) {
  scene_ = &scene;
  object_ = object;
  ignored_ = nullptr;
  other_.link = kNoParent;
}

const MovingSides::States& MovingSides::statesAt(double t) {
  if (t == states_.t) return states_;
  states_.one = one_.side().stateAt(t);
  if (scene_ == nullptr) states_.other = other_.side().stateAt(t);
  states_.t = t;
  return states_;
}

MovingPair MovingSides::at(const SidesPair& pair, double t) {
  if (!isBackward_) return pairAt(pair, t);
  MovingPair back = pairAt(pair, 1.0 - t);
  for (MovingHull* const part : {&back.one, &back.other}) {
    for (Eigen::Vector3d& velocity : part->velocity) velocity = -velocity;
    part->radiusRate = -part->radiusRate;
  }
  return back;
}

MovingPair MovingSides::pairAt(const SidesPair& pair, double t) {
  ++looks;
  work += kLookWork;
  const States& now = statesAt(t);
  MovingHull one = one_.hullAt(pair.one, now.one);
  if (scene_ != nullptr) {
    grow(one, t);
    return movingPair(one, MovingHull::still(scene_->triangle(pair.other.triangle)));
  }
  MovingHull other = other_.hullAt(pair.other, now.other);
  if (asked_ != nullptr) {
    const std::int32_t i = one_.first + pair.one.lss, j = other_.first + pair.other.lss;
    const double share = asked_->radiusShare(std::min(i, j), std::max(i, j));
    one.radius *= share;
    other.radius *= share;
  }
  grow(one, t);
  return movingPair(one, other);
}

void MovingSides::grow(MovingHull& one, double t) const {
  if (growthSign_ == 0.0) return;
  one.radius += growthSign_ * growth_.at(t) * kInflation;
  one.radiusRate = growthSign_ * growth_.rateAt(t);
  one.radiusBend = growthSign_ * growth_.bend();
}

void MovingSides::addBoxes(std::size_t count) {
  work += kBoxWork * count;
}

void MovingSides::collect(double from, double to, double reach, std::vector<SidesPair>& pairs) {
  FORETOUCH_ASSERT(from <= to);
  if (limited_ != nullptr && areNear_) {
    pairs = *limited_;
    return;
  }
  pairs.clear();
  const States end = statesAt(isBackward_ ? 1.0 - from : to);
  const States begin = statesAt(isBackward_ ? 1.0 - to : from);
  const double grown =
      growthSign_ > 0.0 ? reach + growth_.mostIn(begin.t, end.t) * kInflation : reach;
  Collecting in{begin, end, end.t - begin.t, grown, pairs};
  if (limited_ != nullptr) return collectAmong(in);
  if (scene_ == nullptr) {
    collectLinks(in);
  } else {
    for (std::size_t i = 0; i < one_.bounds.size(); ++i) {
      collectScene(in, sweptOfOne(in, static_cast<std::int32_t>(i), Part::whole()));
    }
  }
  // A triangle may be in two LSS.
  if (one_.surface != nullptr || (scene_ == nullptr && other_.surface != nullptr)) {
    std::sort(pairs.begin(), pairs.end(), isBefore);
    pairs.erase(std::unique(pairs.begin(), pairs.end(), areSameSurfaces), pairs.end());
  }
}

SweptTube MovingSides::tubeOf(const Collecting& in, std::int32_t index) const {
  const Lss& lss = (*one_.lss)[slotOf(index)];
  return {lss,
          one_.bounds[slotOf(index)],
          axisEnds(lss, in.begin.one),
          axisEnds(lss, in.end.one),
          in.span,
          in.reach};
}

/// Collects those of them whose boxes meet; for a whole LSS, the triangles that its tube meets. An
/// LSS's pairs lie side by side.
void MovingSides::collectAmong(Collecting& in) const {
  Swept one{-1, Part::whole(), {}};
  std::optional<SweptTube> tube;
  for (const SidesPair& pair : *limited_) {
    const Part part = partOf(pair.one);
    if (pair.one.lss != one.lss || !(part == one.part)) {
      one = sweptOfOne(in, pair.one.lss, part);
      tube.reset();
      if (scene_ != nullptr && part.isWhole()) tube.emplace(tubeOf(in, pair.one.lss));
    }
    const bool isNear =
        scene_ == nullptr
            ? one.box.overlaps(sweptOfOther(in, pair.other.lss, partOf(pair.other)).box)
            : one.box.overlaps(boxOf(scene_->triangle(pair.other.triangle))) &&
                  (!tube || tube->mayMeet(scene_->triangle(pair.other.triangle)));
    if (isNear) in.pairs.push_back(pair);
  }
}

/// What a triangle sweeps: as sweptBox() of an LSS without a radius, for each of its corners.
MovingSides::Swept MovingSides::sweptOf(const LinkSide& side, std::int32_t lss, Part part,
                                        const LinkState& begin, const LinkState& end, double span,
                                        double reach) {
  if (!part.isTriangle()) {
    const Lss& bound = side.side().lssOf(lss, part);
    const AxisBounds bounds =
        part.isWhole() ? side.bounds[slotOf(lss)] : axisBounds(bound, side.inFrame);
    return {lss, part,
            sweptBox(bound, bounds, axisEnds(bound, begin), axisEnds(bound, end), span, reach)};
  }
  Aabb box;
  for (const Eigen::Vector3d& corner : side.surface->triangle(part.index()).vertices) {
    const Lss point{corner, corner, 0.0};
    box.add(sweptBox(point, axisBounds(point, side.inFrame), axisEnds(point, begin),
                     axisEnds(point, end), span, reach));
  }
  return {lss, part, box};
}

MovingSides::Swept MovingSides::sweptOfOne(const Collecting& in, std::int32_t lss,
                                           Part part) const {
  return sweptOf(one_, lss, part, in.begin.one, in.end.one, in.span, in.reach);
}

MovingSides::Swept MovingSides::sweptOfOther(const Collecting& in, std::int32_t lss,
                                             Part part) const {
  return sweptOf(other_, lss, part, in.begin.other, in.end.other, in.span, 0.0);
}

void MovingSides::collectLinks(Collecting& in) {
  work += kBoxWork * one_.bounds.size() * other_.bounds.size();
  for (std::size_t i = 0; i < one_.bounds.size(); ++i) {
    const Swept one = sweptOfOne(in, static_cast<std::int32_t>(i), Part::whole());
    for (std::size_t j = 0; j < other_.bounds.size(); ++j) {
      collectParts(in, one, sweptOfOther(in, static_cast<std::int32_t>(j), Part::whole()));
    }
  }
}

/// Goes down on the side whose box is larger.
void MovingSides::collectParts(Collecting& in, const Swept& one, const Swept& other) {
  if (!one.box.overlaps(other.box)) return;
  const bool isOneDown = one_.side().isSurface(one.lss, one.part);
  const bool isOtherDown = other_.side().isSurface(other.lss, other.part);
  if (isOneDown && isOtherDown) {
    in.pairs.push_back({pieceOf(one.lss, one.part), pieceOf(other.lss, other.part)});
    return;
  }
  const bool goesDownOne = !isOneDown && (isOtherDown || extentOf(one.box) >= extentOf(other.box));
  const LinkSide& side = goesDownOne ? one_ : other_;
  const Swept& above = goesDownOne ? one : other;
  const auto below = side.side().below(above.lss, above.part);
  for (std::size_t i = 0; i < (below[0] == below[1] ? 1 : 2); ++i) {
    work += kBoxWork;
    if (goesDownOne) {
      collectParts(in, sweptOfOne(in, one.lss, below[i]), other);
    } else {
      collectParts(in, one, sweptOfOther(in, other.lss, below[i]));
    }
  }
}

void MovingSides::collectScene(Collecting& in, const Swept& one) {
  found_.clear();
  std::uint64_t visited = 0;
  scene_->parts().bvh.collect(one.box, found_, visited);
  work += kTreeWork + kBoxWork * (visited + found_.size());
  if (found_.empty()) return;
  if (one_.side().isSurface(one.lss, one.part)) return addTriangles(in, one);
  const auto below = one_.side().below(one.lss, one.part);
  collectScene(in, sweptOfOne(in, one.lss, below[0]));
  if (!(below[0] == below[1])) collectScene(in, sweptOfOne(in, one.lss, below[1]));
}

/// Adds the triangles of those found.
void MovingSides::addTriangles(Collecting& in, const Swept& one) {
  std::optional<SweptTube> tube;
  if (!one.part.isTriangle()) {
    tube.emplace(tubeOf(in, one.lss));
  }
  for (const TriangleId id : found_) {
    if (object_ != kNoObject && scene_->object(id) != object_) continue;
    if (ignored_ != nullptr && ignored_->has(*scene_, id)) continue;
    const Triangle& triangle = scene_->triangle(id);
    if ((tube && !tube->mayMeet(triangle)) || !one.box.overlaps(boxOf(triangle))) continue;
    in.pairs.push_back({pieceOf(one.lss, one.part), {-1, id}});
  }
}

}  // namespace foretouch::internal
