// middleware/near/near_query.cpp: one walk of the tree for all LSS, lanes for the triangles of the
// leaves and for their places, doubles for those that count.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"
#include "middleware/near/near_plan.h"
#include "middleware/pair/lane_nearest.h"
#include "middleware/pair/query_plan.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {
namespace {

/// What the places of a triangle cost in lanes, in evaluations of a pair.
constexpr std::uint64_t kPlacesWork = 4;

using internal::NearMemory;
using internal::NearPlace;
using internal::NearPlan;
using internal::StandingLss;

/// One answer.
class NearSearch {
 public:
  NearSearch(const NearPlan& plan, const std::vector<LinkState>& states,
             const std::vector<double>& reach, NearMemory& scratch, NearDetail detail,
             NearFeatures& near)
      : plan_(plan),
        states_(states),
        reach_(reach),
        scratch_(scratch),
        detail_(detail),
        near_(near) {}

  void run() {
    near_.features.clear();
    near_.counters = {};
    near_.links.assign(countOf(plan_.avatar.numLinks()), {});
    LinkId link = 0;
    while (link < plan_.avatar.numLinks()) {
      link = standSome(link);
      walk();
      answerLinks();
    }
  }

 private:
  /// Links from here on, until their LSS fill the boxes of a walk; returns where to go on.
  LinkId standSome(LinkId link) {
    scratch_.lss.clear();
    for (; link < plan_.avatar.numLinks(); ++link) {
      const std::vector<Lss>& own = plan_.avatar.lss(link);
      if (scratch_.lss.size() + own.size() > countOf(internal::BoxLanes::kMaxBoxes)) break;
      FORETOUCH_ASSERT(!std::isnan(reach_[slotOf(link)]) && reach_[slotOf(link)] <= kMaxCoordinate);
      near_.links[slotOf(link)].first = 0;
      if (!(reach_[slotOf(link)] >= 0.0)) continue;
      if (scratch_.ignored.collect(plan_.ignored, link)) continue;
      for (std::size_t i = 0; i < own.size(); ++i) stand(link, i);
    }
    return link;
  }

  void stand(LinkId link, std::size_t i) {
    const Lss& lss = plan_.avatar.lss(link)[i];
    const LinkState& state = states_[slotOf(link)];
    const AxisEnds ends = axisEnds(lss, state);
    const double extent = state.p_WL.lpNorm<1>() + lss.a.lpNorm<1>() + lss.b.lpNorm<1>();
    scratch_.lss.push_back({link, static_cast<std::int32_t>(i), ends.a, ends.b, lss.radius,
                            reach_[slotOf(link)], MotionBounds::kPointRounding * extent});
  }

  void walk() {
    const std::size_t count = scratch_.lss.size();
    const Eigen::Vector3d& origin = plan_.scene.parts().origin;
    internal::BoxLanes boxes;
    boxes.count = static_cast<int>(count);
    for (int axis = 0; axis < 3; ++axis) {
      scratch_.lower[axis].resize(count);
      scratch_.upper[axis].resize(count);
      boxes.lower[axis] = scratch_.lower[axis].data();
      boxes.upper[axis] = scratch_.upper[axis].data();
    }
    for (std::size_t i = 0; i < count; ++i) {
      const StandingLss& lss = scratch_.lss[i];
      Aabb box;
      box.add(lss.a);
      box.add(lss.b);
      box.grow(lss.radius + lss.reach + lss.rounding);
      for (int axis = 0; axis < 3; ++axis) {
        scratch_.lower[axis][i] = internal::floatBelow(box.min[axis] - origin[axis]);
        scratch_.upper[axis][i] = internal::floatAbove(box.max[axis] - origin[axis]);
      }
    }
    scratch_.hits.hits.clear();
    plan_.scene.parts().bvh.collectLeaves(boxes, scratch_.hits.hits, near_.counters.nodes,
                                          near_.counters.leaves);
    scratch_.hits.sortByBox(count);
  }

  void answerLinks() {
    for (std::size_t i = 0; i < scratch_.lss.size();) {
      const LinkId link = scratch_.lss[i].link;
      scratch_.ignored.collect(plan_.ignored, link);
      scratch_.found.clear();
      for (; i < scratch_.lss.size() && scratch_.lss[i].link == link; ++i) answerLss(i);
      keep(link);
    }
  }

  void answerLss(std::size_t i) {
    const internal::HitRange range{scratch_.hits.first[i], scratch_.hits.first[i + 1]};
    if (range.begin == range.end) return;
    const StandingLss& lss = scratch_.lss[i];
    internal::findNear(plan_.scene, {lss.a, lss.b}, lss.radius, lss.reach + lss.rounding, range,
                       scratch_.hits, scratch_.near, near_.counters);
    scratch_.blocks.order(plan_.scene, scratch_.ignored, scratch_.near);
    if (detail_ == NearDetail::Nearest) return findNearest(lss);
    if (detail_ == NearDetail::Reduced) return reduce(lss);
    internal::NearPlaces places;
    for (std::size_t k = 0; k < scratch_.blocks.size(); ++k) {
      findPlaces(lss, scratch_.blocks.id(k), nullptr, places);
      scratch_.found.insert(scratch_.found.end(), places.place, places.place + places.count);
    }
  }

  void findPlaces(const StandingLss& lss, TriangleId id, const internal::NearFilter* filter,
                  internal::NearPlaces& places) {
    ++near_.counters.advancements;
    internal::findPlaces(lss, plan_.scene.triangle(id), id, *plan_.flat, filter, places);
  }

  /// Lanes refuse what cannot win, given what has won so far.
  void reduce(const StandingLss& lss) {
    internal::NearReduction& reduction = scratch_.reduction;
    internal::NearBlocks& blocks = scratch_.blocks;
    reduction.begin(plan_.scene, lss, states_[slotOf(lss.link)].R_WL);
    for (std::size_t from = 0; from < blocks.size(); from += internal::PlaceBlock::kSize) {
      near_.counters.laneSteps += kPlacesWork * internal::PlaceBlock::kSize;
      offer(lss, from, blocks.mayWin(plan_.scene, *plan_.flat, lss, reduction.bins(), from));
    }
    reduction.finish(scratch_.found);
  }

  /// What may win of a block, in doubles.
  void offer(const StandingLss& lss, std::size_t from, const internal::PlaceChoice& choice) {
    internal::NearReduction& reduction = scratch_.reduction;
    const auto next = [&](unsigned& bits) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(bits));
      bits &= bits - 1;
      return scratch_.blocks.id(from + i);
    };
    for (unsigned unsure = choice.unsure; unsure != 0;) {
      internal::NearPlaces places;
      findPlaces(lss, next(unsure), &reduction, places);
      for (int p = 0; p < places.count; ++p) reduction.offer(places.place[p]);
    }
    for (int source = 0; source < internal::kPlaceSources; ++source) {
      for (const bool isWhole : {false, true}) {
        const auto part = static_cast<internal::NearPart>(isWhole ? 0 : 1 + source);
        const unsigned whole = choice.isWhole[source];
        for (unsigned may = choice.may[source] & (isWhole ? whole : ~whole); may != 0;) {
          const TriangleId id = next(may);
          ++near_.counters.advancements;
          reduction.offer(
              internal::placeFrom(lss, plan_.scene.triangle(id), id, *plan_.flat, source, part));
        }
      }
    }
  }

  /// The link's nearest so far is the one in `found`.
  void findNearest(const StandingLss& lss) {
    std::vector<NearPlace>& found = scratch_.found;
    for (std::size_t k = 0; k < scratch_.blocks.size(); ++k) {
      const TriangleId id = scratch_.blocks.id(k);
      if (!found.empty() && scratch_.blocks.gap(k) > found[0].feature.gap) continue;
      ++near_.counters.advancements;
      const NearPlace place =
          internal::closestPlace(lss, plan_.scene.triangle(id), id, *plan_.flat);
      if (place.feature.gap > lss.reach &&
          internal::provenGap(lss, plan_.scene.triangle(id), place) > lss.reach) {
        continue;
      }
      if (found.empty()) {
        found.push_back(place);
      } else if (isNearer(place, found[0])) {
        found[0] = place;
      }
    }
  }

  /// By the separation, since LSS of one link differ in radius.
  [[nodiscard]] bool isNearer(const NearPlace& x, const NearPlace& y) const {
    if (x.feature.gap != y.feature.gap) return x.feature.gap < y.feature.gap;
    return internal::comesBefore(plan_.scene, x, y);
  }

  void keep(LinkId link) {
    std::vector<NearPlace>& found = scratch_.found;
    NearRange& range = near_.links[slotOf(link)];
    if (detail_ == NearDetail::Reduced && found.size() > kMostNearPerLink) {
      range.hadMore = true;
      const auto end = found.begin() + static_cast<std::ptrdiff_t>(kMostNearPerLink);
      std::nth_element(found.begin(), end, found.end(),
                       [this](const NearPlace& x, const NearPlace& y) { return isNearer(x, y); });
      found.resize(kMostNearPerLink);
    }
    range.first = near_.features.size();
    range.count = found.size();
    const StandingLss* const lss =
        std::find_if(scratch_.lss.data(), scratch_.lss.data() + scratch_.lss.size(),
                     [link](const StandingLss& standing) { return standing.link == link; });
    for (const NearPlace& place : found) {
      NearFeature feature = place.feature;
      feature.gap = internal::provenGap(lss[slotOf(feature.lss)],
                                        plan_.scene.triangle(feature.triangle), place);
      near_.features.push_back(feature);
    }
    std::sort(near_.features.begin() + static_cast<std::ptrdiff_t>(range.first),
              near_.features.end(), [](const NearFeature& x, const NearFeature& y) {
                return std::tie(x.lss, x.gap, x.triangle, x.along) <
                       std::tie(y.lss, y.gap, y.triangle, y.along);
              });
  }

  const NearPlan& plan_;
  const std::vector<LinkState>& states_;
  const std::vector<double>& reach_;
  NearMemory& scratch_;
  NearDetail detail_;
  NearFeatures& near_;
};

}  // namespace

Result<NearQuery> NearQuery::build(const Avatar& avatar, const Scene& scene,
                                   const std::vector<IgnoredPair>& ignored) {
  FORETOUCH_CHECK(internal::checkedIgnored(avatar, scene, ignored));
  return NearQuery(std::make_shared<const NearPlan>(
      NearPlan{avatar, scene, ignored, &scene.parts().flatEdges()}));
}

const Avatar& NearQuery::avatar() const {
  return plan_->avatar;
}

const Scene& NearQuery::scene() const {
  return plan_->scene;
}

void NearQuery::answer(const std::vector<LinkState>& states, const std::vector<double>& reach,
                       Scratch& scratch, NearFeatures& near, NearDetail detail) const {
  const std::size_t links = countOf(plan_->avatar.numLinks());
  FORETOUCH_ASSERT(states.size() == links && reach.size() == links);
  NearSearch(*plan_, states, reach, scratch.of<NearMemory>(), detail, near).run();
}

void NearQuery::answer(const Pose& pose, double reach, Scratch& scratch, NearFeatures& near,
                       NearDetail detail) const {
  NearMemory& parts = scratch.of<NearMemory>();
  parts.still.assign(plan_->avatar.skeleton(), pose, pose);
  parts.still.statesAt(0.0, parts.states);
  parts.reach.assign(countOf(plan_->avatar.numLinks()), reach);
  answer(parts.states, parts.reach, scratch, near, detail);
}

}  // namespace foretouch
