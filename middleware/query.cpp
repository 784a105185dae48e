#include "middleware/query.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"
#include "middleware/backtracking.h"
#include "middleware/exact/skin_sweep.h"
#include "middleware/query_internal.h"
#include "middleware/scene_internal.h"
#include "middleware/surface_internal.h"

namespace foretouch {

using internal::Pieces;
using internal::skinOf;
using internal::surfaceOf;

QueryScratch::QueryScratch() : impl_(std::make_unique<Impl>()) {}
QueryScratch::~QueryScratch() = default;
QueryScratch::QueryScratch(QueryScratch&&) noexcept = default;
QueryScratch& QueryScratch::operator=(QueryScratch&&) noexcept = default;

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::Clear: return "clear";
    case Verdict::Contact: return "contact";
    case Verdict::StartsInContact: return "starts_in_contact";
    case Verdict::Undecided: return "undecided";
  }
  return "undecided";
}

const char* toString(UndecidedReason reason) {
  switch (reason) {
    case UndecidedReason::None: return "none";
    case UndecidedReason::WorkBudget: return "work-budget";
    case UndecidedReason::Resolution: return "resolution";
  }
  return "none";
}

const char* toString(LeafMethod method) {
  switch (method) {
    case LeafMethod::Advancement: return "advancement";
    case LeafMethod::Cubics: return "cubics";
  }
  return "advancement";
}

const char* toString(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::Link: return "link";
    case Fidelity::Exact: return "exact";
    case Fidelity::Skinned: return "skinned";
  }
  return "link";
}

namespace {

/// Pieces are made so short that no link moves farther than this (m) in one, up to kMaxPiecesUsed.
/// Longer pieces mean more candidates that are not near, shorter ones more forward kinematics; only
/// speed depends on it.
constexpr double kPieceTravel = 0.08;
constexpr int kMaxPiecesUsed = 12;
static_assert(kMaxPiecesUsed <= internal::kMaxPieces);

Result<Done> checked(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
                     const QueryOptions& options) {
  if (!(options.tolerance >= kMinTolerance) || !std::isfinite(options.tolerance)) {
    return Error{ErrorCode::OutOfRange, "tolerance", -1, -1,
                 "expected a finite number of metres, at least 1e-9"};
  }
  if (motion.numLinks() != avatar.numLinks()) {
    return Error{ErrorCode::Mismatch, "motion", -1, -1,
                 "expected a motion of this avatar's skeleton, found another number of joints"};
  }
  if (options.fidelity == Fidelity::Exact &&
      (!options.surface || options.surface->numLinks() != avatar.numLinks())) {
    return Error{ErrorCode::Mismatch, "fidelity", -1, -1,
                 "expected the surface of this avatar, which exact fidelity needs"};
  }
  if (options.fidelity == Fidelity::Skinned &&
      (!options.skin || options.skin->numLinks() != avatar.numLinks())) {
    return Error{ErrorCode::Mismatch, "fidelity", -1, -1,
                 "expected the skin of this avatar, which skinned fidelity needs"};
  }
  const auto numObjects = static_cast<ObjectId>(scene.objectNames().size());
  for (const IgnoredPair& pair : options.ignored) {
    if (pair.link < 0 || pair.link >= avatar.numLinks() ||
        pair.object < IgnoredPair::kEveryObject || pair.object >= numObjects) {
      return Error{ErrorCode::OutOfRange, "ignored", -1, pair.link,
                   "expected a link of the avatar and an object of the scene"};
    }
  }
  return Done{};
}

Result<const internal::TriangleCuller*> cullerOf(const Scene& scene, Culler which) {
  if (which == Culler::FlatBvh) {
    return static_cast<const internal::TriangleCuller*>(&scene.parts().bvh);
  }
  const auto built = scene.parts().pointQueryCuller();
  if (!built.ok()) return built.error();
  return static_cast<const internal::TriangleCuller*>(built.value());
}

/// One query over all links of one step.
class StepQuery {
 public:
  StepQuery(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
            const QueryOptions& options, const internal::TriangleCuller& culler,
            QueryScratch::Impl& scratch)
      : avatar_(avatar),
        motion_(motion),
        scene_(scene),
        options_(options),
        culler_(culler),
        scratch_(scratch) {}

  StepContacts run() {
    cutIntoPieces();
    StepContacts step;
    step.links.reserve(static_cast<std::size_t>(avatar_.numLinks()));
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      step.links.push_back(firstContactOf(link, step.counters));
    }
    step.counters.states += static_cast<std::uint64_t>(avatar_.numLinks() * (pieces_.count + 1));
    return step;
  }

 private:
  void cutIntoPieces() {
    double travel = 0.0;
    for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
      for (const Lss& lss : avatar_.lss(link)) {
        travel = std::max(travel, axisBounds(lss, motion_.bounds(link)).speed);
      }
    }
    const double wanted = std::ceil(travel / kPieceTravel);
    pieces_.count = static_cast<int>(std::min<double>(kMaxPiecesUsed, std::max(1.0, wanted)));
    scratch_.nodes.resize(static_cast<std::size_t>(pieces_.count) + 1);
    for (int k = 0; k <= pieces_.count; ++k) {
      motion_.statesAt(pieces_.timeOf(k), scratch_.nodes[static_cast<std::size_t>(k)]);
    }
  }

  LinkContact firstContactOf(LinkId link, QueryCounters& counters) {
    skin_ = skinOf(options_, link);
    if (skin_ != nullptr) return firstSkinContactOf(link, counters);
    LinkContact contact;
    contact.link = link;
    surface_ = surfaceOf(options_, link);
    if (scratch_.ignored.collect(options_, link) || avatar_.lss(link).empty()) return contact;
    const Aabb swept = sweep(link);
    scratch_.found.clear();
    culler_.collect(swept, scratch_.found, counters.nodes);
    const internal::LinkQuery query = queryOf(link);
    gather(scratch_.startBoxes, 1);
    counters.candidates += scratch_.candidates.size();
    contact = internal::contactAtStart(query, scratch_.candidates, counters);
    if (contact.verdict != Verdict::Clear) return contact;
    gather(scratch_.boxes, pieces_.count);
    counters.candidates += scratch_.candidates.size();
    return internal::backtrack(query, scratch_.candidates, counters);
  }

  [[nodiscard]] internal::LinkQuery queryOf(LinkId link) const {
    return {{link, avatar_.lss(link), scratch_.axisBounds, motion_, surface_, skin_},
            scene_,
            pieces_,
            options_.tolerance,
            options_.maxAdvancements,
            options_.leafMethod};
  }

  LinkContact firstSkinContactOf(LinkId link, QueryCounters& counters) {
    LinkContact contact;
    contact.link = link;
    const internal::LinkQuery query = queryOf(link);
    const std::int32_t numTriangles = query.parts.skin->numTriangles(link);
    if (scratch_.ignored.collect(options_, link)) return contact;
    internal::sweepSkin(query.parts, scratch_.nodes, pieces_, options_.tolerance,
                        scratch_.startBoxes, scratch_.boxes);
    if (!isNearAnything(scratch_.boxes, counters)) return contact;
    gatherSkin(scratch_.startBoxes, 1, numTriangles, counters);
    contact = internal::contactAtStart(query, scratch_.candidates, counters);
    if (contact.verdict != Verdict::Clear) return contact;
    gatherSkin(scratch_.boxes, pieces_.count, numTriangles, counters);
    return internal::backtrack(query, scratch_.candidates, counters);
  }

  bool isNearAnything(const std::vector<Aabb>& boxes, QueryCounters& counters) {
    Aabb all;
    for (const Aabb& box : boxes) all.add(box);
    scratch_.found.clear();
    culler_.collect(all, scratch_.found, counters.nodes);
    return !scratch_.found.empty();
  }

  /// Pairs of the skin's triangles with the scene's, by `count` boxes a triangle of the skin.
  void gatherSkin(const std::vector<Aabb>& boxes, int count, std::int32_t numTriangles,
                  QueryCounters& counters) {
    scratch_.candidates.clear();
    for (std::int32_t i = 0; i < numTriangles; ++i) {
      const Aabb* const own = boxes.data() + static_cast<std::ptrdiff_t>(i) * count;
      Aabb all;
      for (int k = 0; k < count; ++k) all.add(own[k]);
      scratch_.found.clear();
      culler_.collect(all, scratch_.found, counters.nodes);
      for (const TriangleId id : scratch_.found) {
        if (scratch_.ignored.has(scene_.object(id))) continue;
        const std::uint32_t meets = piecesMeeting(own, count, internal::boxOf(scene_.triangle(id)));
        if (meets == 0) continue;
        scratch_.candidates.push_back(
            {id, 0, meets, 0.0, 0.0, internal::Part::of(HierarchyChild::triangle(i))});
      }
    }
    counters.candidates += scratch_.candidates.size();
  }

  /// Bit k: the k-th of `count` boxes meets `box`.
  [[nodiscard]] static std::uint32_t piecesMeeting(const Aabb* boxes, int count, const Aabb& box) {
    std::uint32_t meets = 0;
    for (int k = 0; k < count; ++k) {
      meets |= static_cast<std::uint32_t>(boxes[k].overlaps(box)) << k;
    }
    return meets;
  }

  /// Boxes of every LSS of the link at the start and on every piece, grown by the tolerance;
  /// returns their union.
  Aabb sweep(LinkId link) {
    Aabb all;
    scratch_.axisBounds.clear();
    scratch_.startBoxes.clear();
    scratch_.boxes.clear();
    for (const Lss& lss : avatar_.lss(link)) {
      const AxisBounds bounds = axisBounds(lss, motion_.bounds(link));
      scratch_.axisBounds.push_back(bounds);
      AxisEnds begin = axisEnds(lss, nodeState(0, link));
      scratch_.startBoxes.push_back(sweptBox(lss, bounds, begin, begin, 0.0, options_.tolerance));
      for (int k = 0; k < pieces_.count; ++k) {
        const AxisEnds end = axisEnds(lss, nodeState(k + 1, link));
        const double span = pieces_.timeOf(k + 1) - pieces_.timeOf(k);
        scratch_.boxes.push_back(sweptBox(lss, bounds, begin, end, span, options_.tolerance));
        all.add(scratch_.boxes.back());
        begin = end;
      }
    }
    return all;
  }

  [[nodiscard]] const LinkState& nodeState(int k, LinkId link) const {
    return scratch_.nodes[static_cast<std::size_t>(k)][static_cast<std::size_t>(link)];
  }

  /// The candidates among the triangles found, by `count` boxes an LSS. This double-precision test
  /// makes every culler's answer the same.
  void gather(const std::vector<Aabb>& boxes, int count) {
    scratch_.candidates.clear();
    const auto numLss = static_cast<std::int32_t>(scratch_.axisBounds.size());
    for (const TriangleId id : scratch_.found) {
      if (scratch_.ignored.has(scene_.object(id))) continue;
      const Aabb box = internal::boxOf(scene_.triangle(id));
      for (std::int32_t lss = 0; lss < numLss; ++lss) {
        const std::uint32_t meets = piecesMeeting(boxes.data() + lss * count, count, box);
        if (meets != 0) {
          scratch_.candidates.push_back({id, lss, meets, 0.0, 0.0, internal::Part::whole()});
        }
      }
    }
  }

  const Avatar& avatar_;
  const ChainMotion& motion_;
  const Scene& scene_;
  const QueryOptions& options_;
  const internal::TriangleCuller& culler_;
  QueryScratch::Impl& scratch_;
  // Of the link at hand; null at other fidelities.
  const internal::LinkSurface* surface_ = nullptr;
  const internal::SkinParts* skin_ = nullptr;
  Pieces pieces_;
};

}  // namespace

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options,
                                   QueryScratch& scratch) {
  const auto check = checked(avatar, motion, scene, options);
  if (!check.ok()) return check.error();
  const auto culler = cullerOf(scene, options.culler);
  if (!culler.ok()) return culler.error();
  return StepQuery(avatar, motion, scene, options, *culler.value(), scratch.impl()).run();
}

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options) {
  QueryScratch scratch;
  return firstContacts(avatar, motion, scene, options, scratch);
}

}  // namespace foretouch
