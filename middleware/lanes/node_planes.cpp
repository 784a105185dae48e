#include "middleware/lanes/node_planes.h"

#include <algorithm>

#include "lss/rounding.h"
#include "middleware/lanes/lane_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "middleware/lanes/node_planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "middleware/lanes/lss_pairs-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Brings a direction below unit length in its frame, past the rounding of its turn there.
constexpr float kTurnShrink = 1.0F - 32.0F * kUnitRoundoffOfFloat;

/// Pairs whose normals are made together.
struct ProposalBlock {
  alignas(64) float a1[3][kMaxLanes], b1[3][kMaxLanes], a2[3][kMaxLanes], b2[3][kMaxLanes];
  alignas(64) float n[3][kMaxLanes];
};

/// `shift`: adds to both ends.
HWY_INLINE void putAxis(const NodeEnds::Axis& axis, int node, const float* shift, std::size_t lane,
                        float (*a)[kMaxLanes], float (*b)[kMaxLanes]) {
  for (int k = 0; k < 3; ++k) {
    a[k][lane] = axis.a[k][node] + shift[k];
    b[k][lane] = axis.b[k][node] + shift[k];
  }
}

HWY_INLINE const NodeEnds::Axis& otherOf(const NodePlanes& planes, const PlanePair& pair) {
  return (planes.others != nullptr ? planes.others : planes.axes)[pair.j];
}

template <class D>
HWY_INLINE Point<hn::Vec<D>> pointOf(D d, const float (*rows)[kMaxLanes], std::size_t lane) {
  return {hn::Load(d, rows[0] + lane), hn::Load(d, rows[1] + lane), hn::Load(d, rows[2] + lane)};
}

/// From the second axis' closest point towards the first's: only proposes.
template <class D>
HWY_INLINE void propose(D d, ProposalBlock& block, std::size_t lane) {
  using V = hn::Vec<D>;
  const Point<V> a1 = pointOf(d, block.a1, lane), a2 = pointOf(d, block.a2, lane);
  const Point<V> d1 = sub(pointOf(d, block.b1, lane), a1), d2 = sub(pointOf(d, block.b2, lane), a2);
  const Point<V> r = sub(a1, a2);
  const V tiny = hn::Set(d, kTiny);
  const V a = hn::Max(dot(d1, d1), tiny), e = hn::Max(dot(d2, d2), tiny), b = dot(d1, d2);
  const V c = dot(d1, r), f = dot(d2, r);
  const V determinant = hn::Max(hn::NegMulAdd(b, b, hn::Mul(a, e)), tiny);
  V s = clamp01(hn::Mul(hn::MulSub(b, f, hn::Mul(c, e)), inverseOf(determinant)));
  const V t = clamp01(hn::Mul(hn::MulAdd(b, s, f), inverseOf(e)));
  s = clamp01(hn::Mul(hn::MulSub(b, t, c), inverseOf(a)));
  const Point<V> n = direction(along(along(r, s, d1), hn::Neg(t), d2));
  hn::Store(n.x, d, block.n[0] + lane);
  hn::Store(n.y, d, block.n[1] + lane);
  hn::Store(n.z, d, block.n[2] + lane);
}

/// A direction of W at a node, as the frame sees it: the plane that rests there.
HWY_INLINE void turnIntoFrame(const NodeFrame& frame, int node, const ProposalBlock& block,
                              std::size_t lane, float* n) {
  for (int k = 0; k < 3; ++k) {
    n[k] = kTurnShrink *
           (frame.R[k][node] * block.n[0][lane] + frame.R[3 + k][node] * block.n[1][lane] +
            frame.R[6 + k][node] * block.n[2][lane]);
  }
}

/// Heights of one axis' ends along the plane's normals at the nodes from `lane` on.
template <class D, class V>
HWY_INLINE V heightOf(D d, const Point<V>& n, const float (*end)[kNodes], int lane) {
  return dot(n, Point<V>{hn::Load(d, end[0] + lane), hn::Load(d, end[1] + lane),
                         hn::Load(d, end[2] + lane)});
}

/// Bit k: the plane that rests in the frame with the normal `n` does not keep the axes apart by
/// enough between nodes k and k + 1.
HWY_INLINE unsigned openPieces(const NodePlanes& planes, const PlanePair& pair, const float* n) {
  const hn::CappedTag<float, kNodes> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<float, kNodes>()));
  const NodeFrame& frame = planes.frames[pair.frame];
  const NodeEnds::Axis &one = planes.axes[pair.i], &other = otherOf(planes, pair);
  const V nx = hn::Set(d, n[0]), ny = hn::Set(d, n[1]), nz = hn::Set(d, n[2]);
  alignas(64) float width[kNodes + 1];
  width[kNodes] = 0.0F;  // the last node has no next one, and no pair has its piece open
  for (int lane = 0; lane < kNodes; lane += kLanes) {
    const auto row = [&](int k) HWY_ATTR {
      return dot(
          Point<V>{hn::Load(d, frame.R[3 * k] + lane), hn::Load(d, frame.R[3 * k + 1] + lane),
                   hn::Load(d, frame.R[3 * k + 2] + lane)},
          Point<V>{nx, ny, nz});
    };
    const Point<V> turned{row(0), row(1), row(2)};
    const V low = hn::Min(heightOf(d, turned, one.a, lane), heightOf(d, turned, one.b, lane));
    const V high = hn::Max(heightOf(d, turned, other.a, lane), heightOf(d, turned, other.b, lane));
    const V shifted = dot(turned, Point<V>{hn::Set(d, planes.shift[0]), hn::Set(d, planes.shift[1]),
                                           hn::Set(d, planes.shift[2])});
    hn::Store(hn::Sub(hn::Sub(low, high), shifted), d, width + lane);
  }
  unsigned open = 0;
  for (int lane = 0; lane < kNodes; lane += kLanes) {
    const V need = hn::MulAdd(hn::Set(d, pair.bend), hn::LoadU(d, planes.sagittas + lane),
                              hn::Set(d, pair.reach));
    // Written so that a NaN leaves its pieces open.
    const auto isWide = hn::And(hn::Gt(hn::Load(d, width + lane), need),
                                hn::Gt(hn::LoadU(d, width + lane + 1), need));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(isWide), bits);
    open |= static_cast<unsigned>(bits[0]) << static_cast<unsigned>(lane);
  }
  return open;
}

/// The normals of at most kMaxLanes pairs; lanes beyond them mean nothing.
HWY_INLINE void proposeAll(const NodePlanes& planes, int node, int otherNode,
                           const PlanePair* pairs, std::size_t count, ProposalBlock& block) {
  const hn::CappedTag<float, kMaxLanes> d;
  constexpr float kNoShift[3] = {0.0F, 0.0F, 0.0F};
  for (std::size_t k = 0; k < count; ++k) {
    putAxis(planes.axes[pairs[k].i], node, kNoShift, k, block.a1, block.b1);
    putAxis(otherOf(planes, pairs[k]), otherNode, planes.shift, k, block.a2, block.b2);
  }
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(d)) propose(d, block, lane);
}

void closePieces(const NodePlanes& planes, int node, PlanePair* pairs, std::size_t count) {
  ProposalBlock block;
  for (std::size_t first = 0; first < count; first += kMaxLanes) {
    const std::size_t here = count - first < kMaxLanes ? count - first : kMaxLanes;
    proposeAll(planes, node, node, pairs + first, here, block);
    for (std::size_t k = 0; k < here; ++k) {
      PlanePair& pair = pairs[first + k];
      float n[3];
      turnIntoFrame(planes.frames[pair.frame], node, block, k, n);
      pair.open = static_cast<std::uint8_t>(pair.open & openPieces(planes, pair, n));
    }
  }
}

/// Per node: 0 in the range; beyond, so much that no height there counts.
struct Beyond {
  alignas(32) float of[kNodes];
  HWY_INLINE explicit Beyond(const NodeRange& range) {
    for (int k = 0; k < kNodes; ++k) of[k] = range.first <= k && k <= range.last ? 0.0F : 1e30F;
  }
};

/// Whether the plane at rest with the normal of lane `k` keeps the pair apart in their ranges.
HWY_INLINE bool restsBetween(const NodePlanes& planes, const Beyond& beyond,
                             const Beyond& beyondOther, const PlanePair& pair,
                             const ProposalBlock& block, std::size_t k) {
  const hn::CappedTag<float, kNodes> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<float, kNodes>()));
  const NodeEnds::Axis &one = planes.axes[pair.i], &other = otherOf(planes, pair);
  const float n[3] = {block.n[0][k], block.n[1][k], block.n[2][k]};
  const Point<V> normal{hn::Set(d, n[0]), hn::Set(d, n[1]), hn::Set(d, n[2])};
  V low = hn::Set(d, 1e30F), high = hn::Set(d, -1e30F);
  for (int lane = 0; lane < kNodes; lane += kLanes) {
    const V least = hn::Min(heightOf(d, normal, one.a, lane), heightOf(d, normal, one.b, lane));
    const V most = hn::Max(heightOf(d, normal, other.a, lane), heightOf(d, normal, other.b, lane));
    low = hn::Min(low, hn::Add(least, hn::Load(d, beyond.of + lane)));
    high = hn::Max(high, hn::Sub(most, hn::Load(d, beyondOther.of + lane)));
  }
  const float shifted = n[0] * planes.shift[0] + n[1] * planes.shift[1] + n[2] * planes.shift[2];
  const float width =
      hn::GetLane(hn::MinOfLanes(d, low)) - hn::GetLane(hn::MaxOfLanes(d, high)) - shifted;
  return width > pair.reach;
}

void closeAtRest(const NodePlanes& planes, int node, int otherNode, PlanePair* pairs,
                 std::size_t count) {
  ProposalBlock block;
  const Beyond beyond(planes.nodes), beyondOther(planes.otherNodes);
  for (std::size_t first = 0; first < count; first += kMaxLanes) {
    const std::size_t here = count - first < kMaxLanes ? count - first : kMaxLanes;
    proposeAll(planes, node, otherNode, pairs + first, here, block);
    for (std::size_t k = 0; k < here; ++k) {
      PlanePair& pair = pairs[first + k];
      if (restsBetween(planes, beyond, beyondOther, pair, block, k)) pair.open = 0;
    }
  }
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {

HWY_EXPORT(closePieces);
HWY_EXPORT(closeAtRest);

void closeByPlanes(const NodePlanes& planes, int node, PlanePair* pairs, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(closePieces)(planes, node, pairs, count);
}

void closeByRestingPlanes(const NodePlanes& planes, int node, int otherNode, PlanePair* pairs,
                          std::size_t count) {
  HWY_DYNAMIC_DISPATCH(closeAtRest)(planes, node, otherNode, pairs, count);
}

}  // namespace foretouch::internal
#endif
