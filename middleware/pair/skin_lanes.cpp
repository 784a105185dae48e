#include "middleware/pair/skin_lanes.h"

#include <algorithm>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "lss/single.h"
#include "tessellation/point_rounding.h"

namespace foretouch::internal {
namespace {

/// Roundings of a place, per share of a blend: its own, and in the sum, the difference, the square
/// and the root (lanes/blend_lanes.md 5).
constexpr double kBlendRoundings = 8.0;

/// The next float or the one after.
float outwardBelow(double x) {
  return -floatPaddedAbove(-x);
}

}  // namespace

void SkinLanes::beginSpan(const SkinParts& skin, const BlendTable& table, const ChainMotion& motion,
                          const ChainNodes& nodes) {
  skin_ = &skin;
  table_ = &table;
  motion_ = &motion;
  nodes_ = &nodes;
  const double gap = widestGap(nodes);
  sagitta_ = gap * gap / 8.0 * kInflation;
  if (spans_.size() < countOf(table.size())) spans_.resize(countOf(table.size()));
  if (frames_.size() < countOf(motion.numLinks())) frames_.resize(countOf(motion.numLinks()));
  areKnown_.assign(countOf(motion.numLinks()), 0);
  link_ = kNoParent;
}

/// What weights that do not add up to 1 may move a point by that is so far from the links' origins.
double SkinLanes::offWorld(double reach) const {
  return table_->sumError() * (nodes_->origin().norm() + nodes_->bounds().reach + reach) *
         kInflation;
}

const SweptBoxes& SkinLanes::linkBoxes(double margin) {
  const LssTable& carried = table_->carried();
  sweptBoxes(carried, *motion_, *nodes_, (margin + offWorld(carried.largestRho())) * kInflation,
             carried_);
  links_.resize(motion_->numLinks());
  for (std::int32_t i = 0; i < carried.size(); ++i) {
    const LinkId owner = table_->owner(i);
    for (int axis = 0; axis < 3; ++axis) {
      float& lower = links_.lower[axis][owner];
      float& upper = links_.upper[axis][owner];
      lower = std::min(lower, carried_.lower[axis][i]);
      upper = std::max(upper, carried_.upper[axis][i]);
    }
  }
  return links_;
}

SkinLanes::Reach SkinLanes::reachOf(const BlendedLss& blended) {
  const BlendShare* const shares = table_->shares(blended);
  const double first = motion_->sums(shares[0].link).accelerationAt(shares[0].rho);
  double reach = 0.0, strays = 0.0, spreads = 0.0, sag = 0.0;
  axis_.clear();
  for (std::int32_t i = 0; i < blended.numShares; ++i) {
    const BlendShare& share = shares[i];
    const double acceleration = motion_->sums(share.link).accelerationAt(share.rho);
    reach = std::max(reach, share.rho);
    sag += share.weight * acceleration;
    spreads += share.spread;
    if (i > 0) strays += share.spread * (acceleration + first);
    axis_.push_back({share.a, blended.isPoint ? share.a : share.b, share.weight, share.spread,
                     &nodes_->link(share.link)});
  }
  Reach result{blendExtent(axis_.data(), blended.numShares), 0.0, sag * sagitta_, 0.0};
  result.rounding =
      kBlendRoundings * (blended.numShares + 1.0) * pointRounding(nodes_->bounds(), reach);
  result.radius = (blended.radius + result.extent.spread + strays * sagitta_ +
                   (1.0 + spreads) * result.rounding + offWorld(reach)) *
                  kInflation;
  return result;
}

void SkinLanes::addBox(std::int32_t lss, double margin, SweptBoxes& boxes) {
  const Reach reach = reachOf((*table_)[lss]);
  Span& span = spans_[slotOf(lss)];
  span.radius = reach.radius;
  const double grown = (reach.radius + reach.sag + reach.rounding + margin) * kInflation;
  for (int axis = 0; axis < 3; ++axis) {
    const double least = reach.extent.least[axis], most = reach.extent.most[axis];
    span.middle[axis] = 0.5 * (least + most);
    boxes.lower[axis][lss] = outwardBelow(least - grown);
    boxes.upper[axis][lss] = floatPaddedAbove(most + grown);
  }
}

const BlendFrame* SkinLanes::framesFor(const LaneBlend& blend) {
  for (int i = 0; i < blend.count; ++i) {
    const LinkId link = blend.shares[i].link;
    if (areKnown_[slotOf(link)] != 0) continue;
    frames_[slotOf(link)] = blendFrame(framePolynomialsOf(link, *motion_, *nodes_));
    areKnown_[slotOf(link)] = 1;
  }
  return frames_.data();
}

LssPolynomials SkinLanes::polynomials(std::int32_t lss) {
  const BlendedLss& blended = (*table_)[lss];
  const Span& span = spans_[slotOf(lss)];
  LssPolynomials result;
  for (int axis = 0; axis < 3; ++axis) result.origin[axis] = nearestFloat(span.middle[axis]);
  const LaneBlend ends[2] = {table_->end(blended, false), table_->end(blended, true)};
  const BlendPoint a = blendPoint(framesFor(ends[0]), ends[0], result.origin);
  const BlendPoint b = blended.isPoint ? a : blendPoint(framesFor(ends[1]), ends[1], result.origin);
  std::copy_n(&a.c[0][0], 3 * kCoefficients, &result.a[0][0]);
  std::copy_n(&b.c[0][0], 3 * kCoefficients, &result.b[0][0]);
  const double pad = std::max(a.bounds.positionPad, b.bounds.positionPad);
  result.radius = floatPaddedAbove((span.radius + pad) * kInflation);
  result.speedA = a.bounds.speed;
  result.speedB = b.bounds.speed;
  result.accelerationA = a.bounds.acceleration;
  result.accelerationB = b.bounds.acceleration;
  result.weighted = std::max(a.bounds.weighted, b.bounds.weighted);
  return result;
}

AxisEnds SkinLanes::endsAt(std::int32_t lss, const std::vector<LinkState>& states) const {
  const BlendedLss& blended = (*table_)[lss];
  AxisEnds ends{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::int32_t i = 0; i < blended.numShares; ++i) {
    const BlendShare& share = table_->shares(blended)[i];
    const LinkState& state = states[slotOf(share.link)];
    ends.a += share.weight * state.pointAt(Eigen::Map<const Eigen::Vector3d>(share.a));
    ends.b += share.weight * state.pointAt(Eigen::Map<const Eigen::Vector3d>(share.b));
  }
  return ends;
}

const FramePolynomials& SkinLanes::beginLink(LinkId link) {
  const LaneShare own{0.0, 0.0F, {}, 0.0F, link};
  const FramePolynomials& frame = framesFor({&own, 1})[link].polynomials;
  if (link == link_) return frame;
  FORETOUCH_ASSERT(skin_->numTriangles(link) > 0);
  link_ = link;
  curves_.clear();
  hulls_.clear();
  curveOf_.assign(countOf(skin_->numTriangles(link)), -1);
  const LssTable& table = table_->table();
  firstPart_ = partsOf(0).first;
  const std::int32_t endPart = partsOf(table.first(link + 1) - table.first(link) - 1).last;
  curveOfPart_.assign(countOf(endPart - firstPart_), -1);
  Eigen::Vector3d origin = nodes_->origin();
  for (int axis = 0; axis < 3; ++axis) origin[axis] += frame.origin[axis];
  originPad_ = table_->sumError() * origin.norm() * kInflation;
  return frame;
}

PartRange SkinLanes::partsOf(std::int32_t lssOfLink) const {
  const BlendedLss& cluster = (*table_)[table_->table().first(link_) + lssOfLink];
  return {cluster.first, cluster.last};
}

PartRange SkinLanes::trianglesOf(HierarchyChild part) const {
  const BlendedLss& of = table_->part(part.index());
  return {of.first, of.last};
}

std::int32_t SkinLanes::curve(HierarchyChild part) {
  std::int32_t& known = part.isTriangle() ? curveOf_[slotOf(part.index())]
                                          : curveOfPart_[slotOf(part.index() - firstPart_)];
  if (known < 0) {
    known = static_cast<std::int32_t>(curves_.size());
    addCurve(part);
  }
  return known;
}

void SkinLanes::addCurve(HierarchyChild part) {
  LaneBlend corners[3];
  double radius = 0.0;
  if (part.isTriangle()) {
    const auto& vertices = skin_->triangle(link_, part.index());
    for (std::size_t i = 0; i < 3; ++i) corners[i] = skin_->blend(vertices[i]);
  } else {
    const BlendedLss& of = table_->part(part.index());
    radius = reachOf(of).radius;
    for (LaneBlend& corner : corners) corner = table_->end(of, false);
  }
  for (const LaneBlend& corner : corners) (void)framesFor(corner);
  curves_.emplace_back();
  BlendTriangle& curve = curves_.back();
  blendTriangle(frames_.data(), corners, frames_[slotOf(link_)].polynomials.origin, curve);
  const float pad = floatAbove(double{curve.bounds.positionPad} + originPad_);
  hulls_.push_back(blendHull(curve, pad, floatAbove(radius)));
}

}  // namespace foretouch::internal
