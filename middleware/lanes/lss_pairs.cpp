#include "middleware/lanes/lss_pairs.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/lss_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/lss_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Pairs left after so many rounds go to the scalar code, which is always right; ordinary pairs
/// need fewer than ten.
constexpr int kMaxRounds = 48;

/// Appends the chosen triangles of every leaf, relative to the origin, to the rows.
std::size_t gatherTriangles(const LeafPart* parts, std::size_t numParts, const FloatBox& box,
                            const float* origin, float reach, const LaneRows& rows,
                            std::size_t count) {
  const hn::CappedTag<float, kBvhWidth> d;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t part = 0; part < numParts; ++part) {
    const BvhLeaf& leaf = *parts[part].leaf;
    const float* const vertices = &leaf.vertex[0][0][0];
    for (std::size_t i = 0; i < kBvhWidth; i += lanes) {
      const unsigned mine = (1U << lanes) - 1U;
      const std::uint8_t bits[8] = {static_cast<std::uint8_t>(parts[part].triangles >> i & mine)};
      if (bits[0] == 0) continue;
      auto meeting = hn::LoadMaskBits(d, bits);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = hn::Load(d, vertices + axis * kBvhWidth + i);
        const auto b = hn::Load(d, vertices + (axis + 3) * kBvhWidth + i);
        const auto c = hn::Load(d, vertices + (axis + 6) * kBvhWidth + i);
        const auto least = hn::Min(hn::Min(a, b), c), most = hn::Max(hn::Max(a, b), c);
        meeting = hn::And(meeting, hn::And(hn::Le(least, hn::Set(d, box.upper[axis])),
                                           hn::Ge(most, hn::Set(d, box.lower[axis]))));
      }
      if (hn::AllFalse(d, meeting)) continue;
      const Chosen<decltype(d)> chosen(d, meeting);
      storeTriangles(trianglesOf(d, vertices + i, origin, reach), chosen, rows, count);
      hn::StoreU(hn::Set(d, parts[part].start), d, rows.time + count);
      chosen.store(hn::Load(di, leaf.id + i), rows.key + count);
      count += chosen.count();
    }
  }
  return count;
}

/// Appends the spheres of clusters, relative to the origin. Keys count from 0.
void gatherSpheres(const Cluster* clusters, const std::int32_t* which, std::size_t count,
                   const float* origin, float reach, float start, const LaneRows& rows) {
  const hn::CappedTag<float, kMaxLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto spheres = spheresOf(d, clusters, which + i, count - i, origin, reach);
    hn::Store(spheres.centre.x, d, rows.coordinates[0] + i);
    hn::Store(spheres.centre.y, d, rows.coordinates[1] + i);
    hn::Store(spheres.centre.z, d, rows.coordinates[2] + i);
    hn::Store(spheres.reach, d, rows.reach + i);
    hn::Store(hn::Set(d, start), d, rows.time + i);
    hn::Store(hn::Iota(di, static_cast<std::int32_t>(i)), di, rows.key + i);
  }
}

std::uint64_t triangleRounds(const LaneLss& lss, const LaneTolerances& tolerances,
                             const LaneRows& rows, std::size_t count, float& best,
                             const HandedRows& handed, std::size_t& handedCount) {
  const hn::CappedTag<float, kMaxLanes> d;
  return advanceAll(d, TriangleKernel{lss, tolerances}, kMaxRounds, rows, count, best, handed,
                    handedCount);
}

std::uint64_t sphereRounds(const LaneLss& lss, const LaneTolerances& tolerances, int maxRounds,
                           const LaneRows& rows, std::size_t count, float best,
                           const HandedRows& handed, std::size_t& handedCount) {
  const hn::CappedTag<float, kMaxLanes> d;
  return advanceAll(d, SphereKernel{lss, tolerances}, maxRounds, rows, count, best, handed,
                    handedCount);
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {

HWY_EXPORT(gatherSpheres);
HWY_EXPORT(gatherTriangles);
HWY_EXPORT(triangleRounds);
HWY_EXPORT(sphereRounds);

std::size_t roundedUp(std::size_t count) {
  return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

/// |p(u)| <= |p(0)| + speed for u in [-1,1] (lss_pairs.md 2).
double extentOf(const float (&c)[3][8], float speed) {
  double squared = 0.0;
  for (const auto& row : c) squared += double{row[0]} * row[0];
  return std::sqrt(squared) + speed;
}

/// The Horner scheme's error of the derivative, in roundoffs of `weighted`: a coefficient c_j takes
/// j ways with at most 13 roundings each, for which 20 are counted, and the sum of (2j+2)|c_j| is
/// more than twice that of j|c_j| (lss_pairs.md 3).
constexpr double kDerivativeRounding = 20.0 / 2.0;

}  // namespace

LaneLss laneLss(const LssPolynomials& polynomials, double lssRadius) {
  LaneLss lane{};
  std::copy_n(&polynomials.a[0][0], 24, &lane.a[0][0]);
  std::copy_n(&polynomials.b[0][0], 24, &lane.b[0][0]);
  lane.radius = polynomials.radius;
  lane.accelerationA = polynomials.accelerationA;
  lane.accelerationB = polynomials.accelerationB;
  const double speed = std::max<double>(polynomials.speedA, polynomials.speedB);
  lane.speedSlack = floatAbove(kUnitRoundoffOfFloat *
                               (4.0 * speed + kDerivativeRounding * double{polynomials.weighted}));
  lane.extent = floatAbove(
      std::max(extentOf(lane.a, polynomials.speedA), extentOf(lane.b, polynomials.speedB)));
  lane.reach = floatAbove(lane.radius + kAxisPlaneRounding * (double{lane.extent} + lane.radius));
  lane.contactShift = floatBelow(2.0 * (static_cast<double>(lane.radius) + lssRadius));
  return lane;
}

void PairLanes::reserve(std::size_t extra) {
  const std::size_t wanted = roundedUp(count_ + extra) + kMaxLanes;
  if (wanted <= capacity_) return;
  const std::size_t grown = std::max(wanted, roundedUp(2 * capacity_));
  auto rows = hwy::AllocateAligned<float>(kRows * grown);
  auto keys = hwy::AllocateAligned<std::int32_t>(grown);
  if (rows == nullptr || keys == nullptr) throw std::bad_alloc();
  // Vectors read the padding, which means nothing.
  std::fill_n(rows.get(), kRows * grown, 0.0F);
  std::fill_n(keys.get(), grown, 0);
  for (std::size_t k = 0; k < kRows; ++k) std::copy_n(row(k), count_, rows.get() + k * grown);
  std::copy_n(keys_.get(), count_, keys.get());
  data_ = std::move(rows);
  keys_ = std::move(keys);
  capacity_ = grown;
}

void PairLanes::addTriangles(const LaneLss& lss, const LeafPart* parts, std::size_t numParts,
                             const FloatBox& box, const float* origin, double vertexRounding) {
  reserve(numParts * kBvhWidth);
  const float reach = floatAbove(double{lss.reach} + vertexRounding);
  count_ =
      HWY_DYNAMIC_DISPATCH(gatherTriangles)(parts, numParts, box, origin, reach, rows(), count_);
}

void PairLanes::setSpheres(const LaneLss& lss, const Cluster* clusters, const std::int32_t* which,
                           std::size_t count, const float* origin, float start) {
  count_ = 0;
  if (count == 0) return;
  reserve(count);
  HWY_DYNAMIC_DISPATCH(gatherSpheres)
  (clusters, which, count, origin, lss.reach, start, rows());
  count_ = count;
}

HandedRows PairLanes::room(HandedOver& handed) const {
  const std::size_t needed = handed.count + count_ + kMaxLanes;
  if (handed.key.size() < needed) {
    handed.key.resize(2 * needed);
    handed.time.resize(2 * needed);
    handed.gap.resize(2 * needed);
  }
  return {handed.key.data(), handed.time.data(), handed.gap.data()};
}

LaneRows PairLanes::rows() {
  LaneRows rows{};
  for (std::size_t k = 0; k < 9; ++k) rows.coordinates[k] = row(k);
  rows.reach = row(9);
  rows.time = row(10);
  rows.key = keys_.get();
  return rows;
}

std::uint64_t PairLanes::advanceTriangles(const LaneLss& lss, const LaneTolerances& tolerances,
                                          float& best, HandedOver& handed) {
  const HandedRows room = this->room(handed);
  const std::size_t count = std::exchange(count_, 0);
  return HWY_DYNAMIC_DISPATCH(triangleRounds)(lss, tolerances, rows(), count, best, room,
                                              handed.count);
}

std::uint64_t PairLanes::advanceSpheres(const LaneLss& lss, const LaneTolerances& tolerances,
                                        int rounds, float best, HandedOver& handed) {
  const HandedRows room = this->room(handed);
  const std::size_t count = std::exchange(count_, 0);
  return HWY_DYNAMIC_DISPATCH(sphereRounds)(lss, tolerances, rounds, rows(), count, best, room,
                                            handed.count);
}

}  // namespace foretouch::internal
#endif
