#include "middleware/lanes/near_triangles.h"

#include <algorithm>
#include <cmath>

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/near_triangles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/lss_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Triangles that lanes take up before they search for their closest points.
constexpr std::size_t kBatch = 64;
/// A leaf more, and a vector beyond that; whole vectors, so that every row is aligned.
constexpr std::size_t kBatchRoom = kBatch + 2 * kMaxLanes;
static_assert(kBvhWidth <= kMaxLanes && kBatchRoom % kMaxLanes == 0);

struct Batch {
  alignas(64) float rows[10][kBatchRoom];
  alignas(64) std::int32_t keys[kBatchRoom];
  std::size_t count;

  [[nodiscard]] LaneRows pointers() {
    LaneRows all{};
    for (int k = 0; k < 9; ++k) all.coordinates[k] = rows[k];
    all.reach = rows[9];
    all.key = keys;
    return all;
  }
};

template <class D>
HWY_INLINE Moving<hn::Vec<D>> standing(D d, const float (&p)[3]) {
  const auto zero = hn::Zero(d);
  return {{hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])}, {zero, zero, zero}};
}

/// Whether it is not provably farther than `within`; NaN is near.
template <class D, class V>
HWY_INLINE hn::Mask<D> isNear(D d, V gap, float within) {
  return hn::Not(hn::Gt(gap, hn::Set(d, within)));
}

/// Planes between the axis and clusters that may be near, one per row.
struct ClusterPlanes {
  alignas(64) float n[3][kMaxLanes];
  alignas(64) float bottom[kMaxLanes];  ///< The lower end's height along n.
  alignas(64) std::int32_t which[kMaxLanes];
};

/// Adds those triangles of a leaf to the batch that a cluster's plane does not prove farther.
void addLeaf(const StillLss& lss, float within, const BvhLeaf& leaf, unsigned asked,
             const ClusterPlanes& planes, std::size_t plane, const float* origin, Batch& batch) {
  const hn::CappedTag<float, kBvhWidth> d;
  using V = hn::Vec<decltype(d)>;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  const Point<V> n{hn::Set(d, planes.n[0][plane]), hn::Set(d, planes.n[1][plane]),
                   hn::Set(d, planes.n[2][plane])};
  const V bottom = hn::Set(d, planes.bottom[plane]);
  for (std::size_t i = 0; i < kBvhWidth; i += lanes) {
    const unsigned mine = (1U << lanes) - 1U;
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(asked >> i & mine)};
    if (bits[0] == 0) continue;
    const Triangles<V> triangles = trianglesOf(d, &leaf.vertex[0][0][0] + i, origin, lss.reach);
    const Point<V>(&v)[3] = triangles.corner;
    const V top = hn::Max(dot(n, v[0]), hn::Max(dot(n, v[1]), dot(n, v[2])));
    const V gap = hn::Sub(hn::Sub(bottom, top), triangles.reach);
    const auto near = hn::And(hn::LoadMaskBits(d, bits), isNear(d, gap, within));
    if (hn::AllFalse(d, near)) continue;
    const Chosen<decltype(d)> chosen(d, near);
    storeTriangles(triangles, chosen, batch.pointers(), batch.count);
    chosen.store(hn::Load(di, leaf.id + i), batch.keys + batch.count);
    batch.count += chosen.count();
  }
}

/// Moves the batch's triangles that may be near to `out`; returns how many.
std::size_t settleBatch(const StillLss& lss, float within, Batch& batch, const HandedRows& out) {
  const hn::CappedTag<float, kMaxLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto a = standing(d, lss.a), b = standing(d, lss.b);
  // The last vector reads beyond the rows, which means nothing.
  for (auto& row : batch.rows) hn::StoreU(hn::Zero(d), d, row + batch.count);
  hn::StoreU(hn::Zero(di), di, batch.keys + batch.count);
  std::size_t found = 0;
  for (std::size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    const auto plane = widestPlane(a, b, loadTriangles(d, batch.pointers(), i)).plane;
    const auto gap = hn::Min(plane.gapA, plane.gapB);
    const auto near = hn::And(hn::FirstN(d, batch.count - i), isNear(d, gap, within));
    if (hn::AllFalse(d, near)) continue;
    const Chosen<decltype(d)> chosen(d, near);
    chosen.store(gap, out.gap + found);
    chosen.store(hn::Load(di, batch.keys + i), out.key + found);
    found += chosen.count();
  }
  batch.count = 0;
  return found;
}

/// Fills rows with the planes of the next clusters that may be near; returns how many.
template <class D>
HWY_INLINE std::size_t nearClusters(D d, const StillLss& lss, float within,
                                    const LeafChoice& choice, std::size_t from, const float* origin,
                                    ClusterPlanes& planes) {
  const hn::RebindToSigned<D> di;
  const auto a = standing(d, lss.a), b = standing(d, lss.b);
  const auto spheres =
      spheresOf(d, choice.clusters, choice.leaf + from, choice.count - from, origin, lss.reach);
  const auto above = planeAbove(a, b, spheres);
  const auto gap = hn::Min(above.plane.gapA, above.plane.gapB);
  const auto near = hn::And(hn::FirstN(d, choice.count - from), isNear(d, gap, within));
  if (hn::AllFalse(d, near)) return 0;
  const Chosen<D> chosen(d, near);
  chosen.store(above.n.x, planes.n[0]);
  chosen.store(above.n.y, planes.n[1]);
  chosen.store(above.n.z, planes.n[2]);
  chosen.store(hn::Min(dot(above.n, a.position), dot(above.n, b.position)), planes.bottom);
  chosen.store(hn::Iota(di, static_cast<std::int32_t>(from)), planes.which);
  return chosen.count();
}

/// `out` has room for all chosen triangles and kMaxLanes more. Returns how many are near.
std::size_t nearTriangles(const StillLss& lss, float within, const LeafChoice& choice,
                          const float* origin, const HandedRows& out, std::size_t& looked) {
  const hn::CappedTag<float, kMaxLanes> d;
  ClusterPlanes planes;
  Batch batch;
  batch.count = 0;
  std::size_t found = 0;
  const auto settle = [&] {
    looked += batch.count;
    found += settleBatch(lss, within, batch, {out.key + found, nullptr, out.gap + found});
  };
  for (std::size_t i = 0; i < choice.count; i += hn::Lanes(d)) {
    const std::size_t count = nearClusters(d, lss, within, choice, i, origin, planes);
    for (std::size_t plane = 0; plane < count; ++plane) {
      const std::int32_t which = planes.which[plane];
      addLeaf(lss, within, choice.leaves[choice.leaf[which]], choice.triangles[which], planes,
              plane, origin, batch);
      if (batch.count >= kBatch) settle();
    }
  }
  if (batch.count != 0) settle();
  return found;
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {

HWY_EXPORT(nearTriangles);

StillLss stillLss(const double* a, const double* b, double radius, double vertexRounding) {
  constexpr double kRounding = 2.0 * double{kUnitRoundoffOfFloat};
  StillLss still{};
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    still.a[axis] = static_cast<float>(a[axis]);
    still.b[axis] = static_cast<float>(b[axis]);
    extent += std::max(std::abs(a[axis]), std::abs(b[axis]));
  }
  const double grown = radius + kRounding * extent;
  still.reach = floatAbove(grown + kAxisPlaneRounding * ((1.0 + kRounding) * extent + grown) +
                           vertexRounding);
  return still;
}

void findNearTriangles(const StillLss& lss, float within, const LeafChoice& choice,
                       const float* origin, NearTriangles& near) {
  const std::size_t room = choice.count * kBvhWidth + kMaxLanes;
  if (near.id.size() < room) {
    near.id.resize(2 * room);
    near.gap.resize(2 * room);
  }
  near.looked = 0;
  near.count = HWY_DYNAMIC_DISPATCH(nearTriangles)(
      lss, within, choice, origin, {near.id.data(), nullptr, near.gap.data()}, near.looked);
}

}  // namespace foretouch::internal
#endif
