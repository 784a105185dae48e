#include "middleware/ask/skin_asker.h"

#include <algorithm>

#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/ask/way_boxes.h"
#include "middleware/surface/skin_parts.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;

/// The rounding of a blended place, per share of it, beside the roundings of the links' places;
/// relative to the largest of these (ask.md 9).
constexpr double kBlendRounding = 4.0 * kUnitRoundoff;

bool isNearer(const SkinMemory::Near& x, const SkinMemory::Near& y) {
  return x.bound != y.bound ? x.bound < y.bound : x.blend < y.blend;
}

Vector3d cornerAt(const std::vector<SkinInfluence>& shares, const std::vector<LinkPlace>& places) {
  Vector3d sum = Vector3d::Zero();
  for (const SkinInfluence& share : shares) {
    sum += share.weight * places[slotOf(share.link)].at(share.p_L);
  }
  return sum;
}

}  // namespace

SkinAsker::SkinAsker(const BodyKind& kind, const AskedShape& shape, const AskFilter& filter,
                     bool isAssumed, HitList& hits, SkinMemory& memory)
    : kind_(kind),
      skin_(kind.skin->parts()),
      blends_(*skin_.blends),
      shape_(shape),
      filter_(filter),
      isAssumed_(isAssumed),
      hits_(hits),
      memory_(memory) {}

double SkinAsker::limit() const {
  return std::min(shape_.reach, hits_.limit() - shape_.moved);
}

void SkinAsker::clearBoxes() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    memory_.lower[axis].clear();
    memory_.upper[axis].clear();
  }
}

void SkinAsker::findBounds(const Vector3d& origin, double extent) {
  const double *const lower[3] = {memory_.lower[0].data(), memory_.lower[1].data(),
                                  memory_.lower[2].data()},
                      *const upper[3] = {memory_.upper[0].data(), memory_.upper[1].data(),
                                         memory_.upper[2].data()};
  memory_.bounds.resize(memory_.lower[0].size());
  WayBoxes(shape_, origin, extent)
      .nearest(static_cast<int>(memory_.bounds.size()), lower, upper, memory_.bounds.data());
}

bool SkinAsker::takesTriangles(BodyId body) const {
  for (LinkId link = 0; link < kind_.skeleton.numJoints(); ++link) {
    if (skin_.numTriangles(link) > 0 && filter_.takes(body, link, kEveryObject)) return true;
  }
  return false;
}

bool SkinAsker::findLinks(BodyId body, const PieceBoxes* pieces) {
  const std::int32_t count = kind_.skeleton.numJoints();
  memory_.bounds.assign(countOf(count), 0.0);
  if (pieces != nullptr) {
    // What a link's surface may be is within the hull of all that is carried of it.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      memory_.lower[axis].assign(countOf(count), kBeyondReach);
      memory_.upper[axis].assign(countOf(count), -kBeyondReach);
      for (std::size_t i = 0; i < pieces->lower[axis].size(); ++i) {
        const auto owner = slotOf(blends_.owner(static_cast<std::int32_t>(i)));
        double &low = memory_.lower[axis][owner], &high = memory_.upper[axis][owner];
        low = std::min(low, static_cast<double>(pieces->lower[axis][i]));
        high = std::max(high, static_cast<double>(pieces->upper[axis][i]));
      }
      const double slack = skinSlack(kind_, pieces->box);
      for (double& low : memory_.lower[axis]) low -= slack;
      for (double& high : memory_.upper[axis]) high += slack;
    }
    findBounds(pieces->origin, (pieces->box.max - pieces->origin).lpNorm<1>() +
                                   (pieces->box.min - pieces->origin).lpNorm<1>());
  }
  memory_.links.clear();
  memory_.bare.clear();
  for (LinkId link = 0; link < count; ++link) {
    if (memory_.bounds[slotOf(link)] > limit() || !filter_.takes(body, link, kEveryObject))
      continue;
    (skin_.numTriangles(link) > 0 ? memory_.links : memory_.bare).push_back(link);
  }
  return !memory_.links.empty() || !memory_.bare.empty();
}

/// Takes the rounding of all places that are blended from these.
void SkinAsker::takeRounding(const std::vector<LinkPlace>& places) {
  double rounding = 0.0, most = 0.0;
  for (const LinkPlace& place : places) {
    rounding = std::max(rounding, place.roundingAt(kind_.rho));
    most = std::max(most, place.p_WL.norm() + kind_.rho);
  }
  const auto shares = static_cast<double>(skin_.mostShares + places.size());
  shape_.rounding +=
      (rounding + shares * kBlendRounding * most) * (1.0 + blends_.sumError()) * kInflation;
}

/// Adds the ball around a cluster or a part, by BlendedLss.
void SkinAsker::addBall(const BlendedLss& blend, const std::vector<LinkPlace>& places) {
  const BlendShare* const shares = blends_.shares(blend);
  Vector3d middle = Vector3d::Zero(), first = Vector3d::Zero();
  double radius = blend.radius;
  for (std::int32_t i = 0; i < blend.numShares; ++i) {
    const BlendShare& share = shares[i];
    const Vector3d y = places[slotOf(share.link)].at(Vector3d(share.a));
    if (i == 0) first = y;
    middle += share.weight * y;
    radius += share.spread * ((y - first).norm() + 2.0 * shape_.rounding);
  }
  radius = (radius + blends_.sumError() * first.norm()) * kInflation;
  for (int axis = 0; axis < 3; ++axis) {
    memory_.lower[slotOf(axis)].push_back(middle[axis] - radius);
    memory_.upper[slotOf(axis)].push_back(middle[axis] + radius);
  }
}

void SkinAsker::askTriangles(ContactSide side, const std::vector<LinkPlace>& places) {
  takeRounding(places);
  double extent = 0.0;
  for (const LinkPlace& place : places) {
    extent = std::max(extent, 2.0 * (place.p_WL.lpNorm<1>() + 2.0 * kind_.rho));
  }
  const auto bounded = [&](std::vector<SkinMemory::Near>& near) {
    findBounds(Vector3d::Zero(), extent);
    for (std::size_t i = 0; i < near.size(); ++i) near[i].bound = memory_.bounds[i];
    std::sort(near.begin(), near.end(), isNearer);
  };
  clearBoxes();
  memory_.clusters.clear();
  const LssTable& table = blends_.table();
  for (const LinkId link : memory_.links) {
    for (std::int32_t i = table.first(link); i < table.first(link + 1); ++i) {
      memory_.clusters.push_back({0.0, link, i});
      addBall(blends_[i], places);
    }
  }
  bounded(memory_.clusters);
  const LinkPlace inPlace;
  PieceAsker asker(filter_, shape_, inPlace, isAssumed_, hits_);
  for (const SkinMemory::Near& cluster : memory_.clusters) {
    if (cluster.bound > limit()) break;
    side.link = cluster.link;
    clearBoxes();
    memory_.parts.clear();
    for (std::int32_t i = blends_[cluster.blend].first; i < blends_[cluster.blend].last; ++i) {
      memory_.parts.push_back({0.0, cluster.link, i});
      addBall(blends_.part(i), places);
    }
    bounded(memory_.parts);
    for (const SkinMemory::Near& part : memory_.parts) {
      if (part.bound > limit()) break;
      askPart(side, part.blend, places, asker);
    }
  }
}

void SkinAsker::askPart(ContactSide& side, std::int32_t part, const std::vector<LinkPlace>& places,
                        PieceAsker& asker) {
  const BlendedLss& blend = blends_.part(part);
  for (std::int32_t i = blend.first; i < blend.last; ++i) {
    side.triangle = blends_.triangle(i);
    Triangle triangle;
    const auto& corners = skin_.triangle(side.link, side.triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.vertices[k] = cornerAt(skin_.skin.vertices[slotOf(corners[k])], places);
    }
    asker.askTriangle(triangle, side, kEveryObject);
  }
}

}  // namespace foretouch::internal
