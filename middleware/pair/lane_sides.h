// middleware/pair/lane_sides.h: what the pairs of LaneBacktracker are made of, and what is below
// each: the triangles of a link's mesh or skin against triangles of the scene, or of another link's
// mesh. Not installed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lss/index.h"
#include "middleware/pair/link_query.h"
#include "middleware/pair/part_pairs.h"

namespace foretouch::internal {

/// What all sides share. A pair whose two sides have nothing below is of surfaces: doubles decide.
class LaneSides {
 public:
  /// Pairs up to `reach` (m) apart count from now on.
  static void widen(double /*reach*/) {}
  /// The candidates are others than before.
  static void readCandidates() {}

 protected:
  LaneSides(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch)
      : query_(query), candidates_(candidates), scratch_(scratch) {}

  [[nodiscard]] Candidate& candidateOf(const PartPair& pair) const {
    return candidates_[slotOf(pair.candidate)];
  }
  [[nodiscard]] float laneTime(const PartPair& pair) const {
    return scratch_.lanes.laneTime(pair.freeUntil);
  }
  /// The scene's triangle, in the lanes.
  [[nodiscard]] std::int32_t laneTriangle(const PartPair& pair) const {
    Candidate& candidate = candidateOf(pair);
    if (candidate.laneTriangle < 0) {
      candidate.laneTriangle = scratch_.lanes.add(query_.scene->triangle(candidate.triangle));
    }
    return candidate.laneTriangle;
  }

  const LinkQuery& query_;
  std::vector<Candidate>& candidates_;
  PartScratch& scratch_;
};

/// A link's meshes under their LSS.
class MeshSides : private LaneSides {
 public:
  /// Contacts at the start are left to the caller.
  static constexpr bool kAnswersStarts = false;
  using LaneSides::candidateOf;
  using LaneSides::readCandidates;
  using LaneSides::widen;
  MeshSides(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch)
      : LaneSides(query, candidates, scratch), surface_(*query.one.surface) {
    surface_.prepare();
  }

  [[nodiscard]] static bool isSurface(const PartPair& pair) {
    return !pair.isWhole && pair.part.isTriangle();
  }
  /// Replaces a whole LSS, which lanes gave up, by what is below it; false if there is nothing.
  template <typename Push>
  [[nodiscard]] bool enter(PartPair pair, const Push& push) const {
    // An LSS that contains no triangle is the surface.
    if (!pair.isWhole || !surface_.hasTriangles(candidateOf(pair).lss)) return false;
    pair.isWhole = false;
    pair.part = surface_.root(candidateOf(pair).lss);
    pair.part.isTriangle() ? push(pair) : descend(pair, push);
    return true;
  }
  template <typename Push>
  void descend(PartPair pair, const Push& push) const {
    for (const HierarchyChild part : surface_.below(candidateOf(pair).lss, pair.part)) {
      pair.part = part;
      push(pair);
    }
  }
  [[nodiscard]] bool isForDoubles(const PartPair& pair) const {
    return pair.isWhole || (pair.part.isTriangle() && query_.leafProver != nullptr);
  }
  void put(std::size_t lane, const PartPair& pair, float floor) const {
    scratch_.lanes.put(lane, laneTriangle(pair),
                       surface_.lanePart(candidateOf(pair).lss, pair.part), laneTime(pair), floor);
  }
  void prove(bool areSurfaces, std::size_t count) const {
    areSurfaces ? scratch_.lanes.proveTriangles(count) : scratch_.lanes.proveLss(count);
  }
  [[nodiscard]] Candidate inDoubles(const PartPair& pair) const {
    Candidate candidate = candidateOf(pair);
    if (!pair.isWhole) candidate.part = Part::of(pair.part);
    return candidate;
  }

 private:
  const LinkSurface& surface_;
};

/// A link's triangles of a skin under their clusters.
class SkinSides : private LaneSides {
 public:
  static constexpr bool kAnswersStarts = false;
  using LaneSides::candidateOf;
  using LaneSides::readCandidates;
  SkinSides(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch)
      : LaneSides(query, candidates, scratch), reach_(reachInLanes(query.tolerance)) {}

  void widen(double reach) { reach_ = std::max(reach_, reachInLanes(reach)); }
  [[nodiscard]] static bool isSurface(const PartPair& pair) {
    return !pair.isWhole && pair.part.isTriangle();
  }
  template <typename Push>
  [[nodiscard]] bool enter(PartPair pair, const Push& push) const {
    if (!pair.isWhole) return false;
    pair.isWhole = false;
    const PartRange parts = scratch_.skin.partsOf(candidateOf(pair).lss);
    for (std::int32_t part = parts.first; part < parts.last; ++part) {
      pushIfNear(pair, HierarchyChild::node(part), push);
    }
    return true;
  }
  template <typename Push>
  void descend(const PartPair& pair, const Push& push) const {
    const PartRange triangles = scratch_.skin.trianglesOf(pair.part);
    for (std::int32_t i = triangles.first; i < triangles.last; ++i) {
      pushIfNear(pair, scratch_.skin.triangle(i), push);
    }
  }
  [[nodiscard]] static bool isForDoubles(const PartPair& /*pair*/) { return false; }
  void put(std::size_t lane, const PartPair& pair, float floor) const {
    const std::int32_t curve = scratch_.skin.curve(pair.part);
    scratch_.lanes.putBlend(lane, laneTriangle(pair), curve, scratch_.skin.hull(curve),
                            laneTime(pair), floor);
  }
  void prove(bool areSurfaces, std::size_t count) const {
    const BlendTriangle* const curves = scratch_.skin.curves();
    areSurfaces ? scratch_.lanes.proveBlendedTriangles(curves, count)
                : scratch_.lanes.proveBlendedParts(curves, count);
  }
  [[nodiscard]] Candidate inDoubles(const PartPair& pair) const {
    Candidate candidate = candidateOf(pair);
    candidate.part = Part::of(pair.part);
    candidate.lss = 0;  // a cluster's number means nothing outside
    return candidate;
  }

 private:
  /// Pushes it unless the boxes over the whole span are farther apart than any contact.
  template <typename Push>
  void pushIfNear(PartPair pair, HierarchyChild part, const Push& push) const {
    const CurveBox& scene = scratch_.lanes.box(laneTriangle(pair));
    if (!scratch_.skin.hull(scratch_.skin.curve(part)).swept.isNear(scene, reach_)) return;
    pair.part = part;
    push(pair);
  }

  float reach_;  // in lanes
};

/// The meshes of two links, each under its LSS; an LSS without triangles is its side's surface.
class OwnSides : private LaneSides {
 public:
  static constexpr bool kAnswersStarts = true;
  using LaneSides::candidateOf;
  using LaneSides::widen;
  OwnSides(const LinkQuery& query, std::vector<Candidate>& candidates, PartScratch& scratch)
      : LaneSides(query, candidates, scratch) {
    const LinkSurface *const one = query.one.surface, *const other = query.other->surface;
    if (one != nullptr) other == nullptr ? one->prepareWide() : one->prepare();
    if (other != nullptr) one == nullptr ? other->prepareWide() : other->prepare();
    if (one == nullptr || other == nullptr) {
      kind_ = one == nullptr ? BothParts::AxisOfOne : BothParts::AxisOfOther;
    }
  }

  void readCandidates() {
    scratch_.wholeParts.clear();
    for (const Candidate& candidate : candidates_) {
      scratch_.wholeParts.push_back({lanePart(query_.one.lss[slotOf(candidate.lss)]),
                                     lanePart(query_.other->lss[slotOf(candidate.otherLss)])});
    }
  }
  [[nodiscard]] static bool isSurface(const PartPair& pair) {
    return pair.isEntered && isOnTop(pair.isWhole, pair.part) &&
           isOnTop(pair.isOtherWhole, pair.otherPart);
  }
  template <typename Push>
  [[nodiscard]] bool enter(PartPair pair, const Push& push) const {
    if (pair.isEntered) return false;
    const Candidate& candidate = candidateOf(pair);
    pair.isEntered = true;
    enterSide(query_.one, candidate.lss, pair.isWhole, pair.part);
    enterSide(*query_.other, candidate.otherLss, pair.isOtherWhole, pair.otherPart);
    push(pair);
    return true;
  }
  /// The side with the larger radius gives way.
  template <typename Push>
  void descend(PartPair pair, const Push& push) const {
    const Candidate& candidate = candidateOf(pair);
    const bool isOther =
        radiusOf(*query_.other, candidate.otherLss, pair.isOtherWhole, pair.otherPart) >
        radiusOf(query_.one, candidate.lss, pair.isWhole, pair.part);
    const Side& side = isOther ? *query_.other : query_.one;
    const std::int32_t lss = isOther ? candidate.otherLss : candidate.lss;
    HierarchyChild& part = isOther ? pair.otherPart : pair.part;
    for (const HierarchyChild below : side.surface->below(lss, part)) {
      // Meshes are larger than caches; others are looked at before this one's turn.
      __builtin_prefetch(&side.surface->lanePart(lss, below));
      part = below;
      push(pair);
    }
  }
  /// One instant, at which all parts stand still. Precondition, as of the next three: one of the
  /// links has no mesh.
  void stopAt(const PosedLink& posed) {
    const Side &mesh = meshSide(), &plain = plainSide();
    const bool isOther = &mesh == query_.other;
    const MotionBounds bounds = mesh.bounds();
    scratch_.stillAxes.clear();
    for (const Candidate& candidate : candidates_) {
      const auto lss = slotOf(isOther ? candidate.lss : candidate.otherLss);
      scratch_.stillAxes.push_back(stillAxis(plain.lss[lss], isOther ? posed.state : posed.other,
                                             plain.axisBounds[lss],
                                             isOther ? posed.other : posed.state, bounds));
    }
  }
  /// The candidate's whole mesh; nothing if its two LSS are all there is.
  [[nodiscard]] std::optional<StillPair> wholeStill(std::int32_t candidate) const {
    const Side& mesh = meshSide();
    const std::int32_t lss = meshLss(candidate);
    if (!mesh.surface->hasTriangles(lss)) return std::nullopt;
    return StillPair{-std::numeric_limits<float>::infinity(), candidate, mesh.surface->root(lss)};
  }
  /// What is below a pair that is not of surfaces.
  [[nodiscard]] const WideNode& belowStill(const StillPair& pair) const {
    return meshSide().surface->wideNode(meshLss(pair.candidate), pair.part);
  }
  /// The pair as one that goes on from `t`.
  [[nodiscard]] PartPair movingFrom(double t, const StillPair& pair) const {
    PartPair moving;
    moving.freeUntil = t;
    moving.candidate = pair.candidate;
    moving.isEntered = true;
    const bool isOther = &meshSide() == query_.other;
    (isOther ? moving.isOtherWhole : moving.isWhole) = false;
    (isOther ? moving.otherPart : moving.part) = pair.part;
    return moving;
  }

  [[nodiscard]] static bool isForDoubles(const PartPair& /*pair*/) { return false; }
  void put(std::size_t lane, const PartPair& pair, float floor) const {
    const auto& [one, other] = scratch_.wholeParts[slotOf(pair.candidate)];
    const Candidate& candidate = candidateOf(pair);
    scratch_.lanes.putBoth(
        lane, pair.isWhole ? one : query_.one.surface->lanePart(candidate.lss, pair.part),
        pair.isOtherWhole ? other
                          : query_.other->surface->lanePart(candidate.otherLss, pair.otherPart),
        laneTime(pair), floor);
  }
  void prove(bool areSurfaces, std::size_t count) const {
    scratch_.lanes.proveBoth(kind_, areSurfaces, count);
  }
  [[nodiscard]] Candidate inDoubles(const PartPair& pair) const {
    Candidate candidate = candidateOf(pair);
    if (!pair.isWhole) candidate.part = Part::of(pair.part);
    if (!pair.isOtherWhole) candidate.otherPart = Part::of(pair.otherPart);
    return candidate;
  }

 private:
  [[nodiscard]] const Side& meshSide() const {
    return query_.one.surface != nullptr ? query_.one : *query_.other;
  }
  [[nodiscard]] const Side& plainSide() const {
    return query_.one.surface != nullptr ? *query_.other : query_.one;
  }
  [[nodiscard]] std::int32_t meshLss(std::int32_t candidate) const {
    const Candidate& own = candidates_[slotOf(candidate)];
    return query_.one.surface != nullptr ? own.lss : own.otherLss;
  }
  [[nodiscard]] static bool isOnTop(bool isWhole, HierarchyChild part) {
    return isWhole || part.isTriangle();
  }
  static void enterSide(const Side& side, std::int32_t lss, bool& isWhole, HierarchyChild& part) {
    isWhole = side.surface == nullptr || !side.surface->hasTriangles(lss);
    if (!isWhole) part = side.surface->root(lss);
  }
  /// Below zero where nothing is below.
  [[nodiscard]] static float radiusOf(const Side& side, std::int32_t lss, bool isWhole,
                                      HierarchyChild part) {
    return isOnTop(isWhole, part) ? -1.0F : side.surface->lanePart(lss, part).radius;
  }

  BothParts kind_ = BothParts::Triangles;
};

}  // namespace foretouch::internal
