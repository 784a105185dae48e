// tessellation/point_lanes-inl.h: a point of a link at the nodes of a span, in lanes. For inclusion
// in sources that Highway compiles once per width.
#if defined(FORETOUCH_TESSELLATION_POINT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_TESSELLATION_POINT_LANES_INL_H_
#undef FORETOUCH_TESSELLATION_POINT_LANES_INL_H_
#else
#define FORETOUCH_TESSELLATION_POINT_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "articulated/chain_nodes.h"
#include "lss/double_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using NodeLanes = HWY_CAPPED(double, kNodes);
using NodeVector = hn::Vec<NodeLanes>;

/// Coordinate `axis` of the point `p_L` of the link, from node `lane` on, relative to the origin of
/// the nodes and then to `shift`.
HWY_INLINE NodeVector pointAt(NodeLanes d, const LinkNodes& link, const double* p_L, double shift,
                              int axis, int lane) {
  NodeVector sum = hn::Sub(hn::Load(d, link.p[axis] + lane), hn::Set(d, shift));
  for (int i = 0; i < 3; ++i) {
    sum = hn::MulAdd(hn::Load(d, link.R[3 * axis + i] + lane), hn::Set(d, p_L[i]), sum);
  }
  return sum;
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
