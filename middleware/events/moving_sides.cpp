#include "middleware/events/moving_sides.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/events/swept_tube.h"
#include "middleware/scene/culler.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

/// As measured, roughly: a distance, two boxes, and what a tree of triangles takes.
constexpr std::uint64_t kLookWork = 40, kBoxWork = 4, kTreeWork = 50;

}  // namespace

void MovingSides::begin(LinkId frame) {
  frame_ = frame;
  asked_ = nullptr;
  scene_ = nullptr;
  states_.t = std::numeric_limits<double>::quiet_NaN();
}

void MovingSides::setSide(LinkSide& side, MotionEvaluator& evaluator, LinkId link,
                          const std::vector<Lss>& lss) {
  side.evaluator = &evaluator;
  side.link = link;
  side.lss = &lss;
  side.first = 0;
  side.frame = frame_;
  side.inFrame = evaluator.motion().sumsIn(frame_, link).bounds();
  side.bounds.clear();
  for (const Lss& one : lss) side.bounds.push_back(axisBounds(one, side.inFrame));
  states_.t = std::numeric_limits<double>::quiet_NaN();
}

void MovingSides::setLink(MotionEvaluator& evaluator, LinkId link, const std::vector<Lss>& lss) {
  setSide(one_, evaluator, link, lss);
}

void MovingSides::setOther(MotionEvaluator& evaluator, LinkId link, const std::vector<Lss>& lss) {
  setSide(other_, evaluator, link, lss);
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
  ++looks;
  work += kLookWork;
  const States& now = statesAt(t);
  MovingHull one = one_.side().hullAt(pair.lss, Part::whole(), now.one);
  if (scene_ != nullptr) {
    return movingPair(one, MovingHull::still(scene_->triangle(pair.other)));
  }
  MovingHull other = other_.side().hullAt(pair.other, Part::whole(), now.other);
  if (asked_ != nullptr) {
    const std::int32_t i = one_.first + pair.lss, j = other_.first + pair.other;
    const double share = asked_->radiusShare(std::min(i, j), std::max(i, j));
    one.radius *= share;
    other.radius *= share;
  }
  return movingPair(one, other);
}

void MovingSides::collect(double from, double to, double reach, std::vector<SidesPair>& pairs) {
  FORETOUCH_ASSERT(from <= to);
  pairs.clear();
  const States end = statesAt(to);
  const States begin = statesAt(from);
  if (scene_ != nullptr) {
    collectScene(begin, end, reach, pairs);
  } else {
    collectLinks(begin, end, reach, pairs);
  }
}

Aabb MovingSides::sweptBoxOf(const LinkSide& side, std::size_t i, const LinkState& begin,
                             const LinkState& end, double span, double reach) {
  const Lss& lss = (*side.lss)[i];
  return sweptBox(lss, side.bounds[i], axisEnds(lss, begin), axisEnds(lss, end), span, reach);
}

void MovingSides::collectLinks(const States& begin, const States& end, double reach,
                               std::vector<SidesPair>& pairs) {
  const double span = end.t - begin.t;
  work += kBoxWork * one_.bounds.size() * other_.bounds.size();
  for (std::size_t i = 0; i < one_.bounds.size(); ++i) {
    const Aabb box = sweptBoxOf(one_, i, begin.one, end.one, span, reach);
    for (std::size_t j = 0; j < other_.bounds.size(); ++j) {
      if (!box.overlaps(sweptBoxOf(other_, j, begin.other, end.other, span, 0.0))) continue;
      pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  }
}

void MovingSides::collectScene(const States& begin, const States& end, double reach,
                               std::vector<SidesPair>& pairs) {
  for (std::size_t i = 0; i < one_.bounds.size(); ++i) {
    const double span = end.t - begin.t;
    const Aabb box = sweptBoxOf(one_, i, begin.one, end.one, span, reach);
    const Lss& lss = (*one_.lss)[i];
    const SweptTube tube(lss, one_.bounds[i], axisEnds(lss, begin.one), axisEnds(lss, end.one),
                         span, reach);
    found_.clear();
    std::uint64_t visited = 0;
    scene_->parts().bvh.collect(box, found_, visited);
    work += kTreeWork + kBoxWork * (visited + found_.size());
    for (const TriangleId id : found_) {
      if (object_ != kNoObject && scene_->object(id) != object_) continue;
      const Triangle& triangle = scene_->triangle(id);
      if (!tube.mayMeet(triangle) || !box.overlaps(boxOf(triangle))) continue;
      pairs.push_back({static_cast<std::int32_t>(i), id});
    }
  }
}

}  // namespace foretouch::internal
