// middleware/lanes/points-inl.h: points and directions of float lanes, for all kernels of pairs;
// compiled once per vector width. Nothing in here may be shared with other sources
// (lss_pairs-inl.h).
#if defined(FORETOUCH_LANES_POINTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_LANES_POINTS_INL_H
#undef FORETOUCH_LANES_POINTS_INL_H
#else
#define FORETOUCH_LANES_POINTS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Point {
  V x, y, z;
};
template <class V>
HWY_INLINE Point<V> sub(const Point<V>& p, const Point<V>& q) {
  return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y), hn::Sub(p.z, q.z)};
}
template <class V>
HWY_INLINE V dot(const Point<V>& p, const Point<V>& q) {
  return hn::MulAdd(p.z, q.z, hn::MulAdd(p.y, q.y, hn::Mul(p.x, q.x)));
}
template <class V>
HWY_INLINE Point<V> cross(const Point<V>& p, const Point<V>& q) {
  return {hn::NegMulAdd(p.z, q.y, hn::Mul(p.y, q.z)), hn::NegMulAdd(p.x, q.z, hn::Mul(p.z, q.x)),
          hn::NegMulAdd(p.y, q.x, hn::Mul(p.x, q.y))};
}
/// p + s q
template <class V>
HWY_INLINE Point<V> along(const Point<V>& p, V s, const Point<V>& q) {
  return {hn::MulAdd(s, q.x, p.x), hn::MulAdd(s, q.y, p.y), hn::MulAdd(s, q.z, p.z)};
}
/// p - s q
template <class V>
HWY_INLINE Point<V> against(const Point<V>& p, V s, const Point<V>& q) {
  return {hn::NegMulAdd(s, q.x, p.x), hn::NegMulAdd(s, q.y, p.y), hn::NegMulAdd(s, q.z, p.z)};
}
template <class V>
HWY_INLINE Point<V> scaled(V s, const Point<V>& p) {
  return {hn::Mul(s, p.x), hn::Mul(s, p.y), hn::Mul(s, p.z)};
}
template <class M, class V>
HWY_INLINE Point<V> select(M mask, const Point<V>& yes, const Point<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}
template <class V>
HWY_INLINE V clamp01(V x) {
  const hn::DFromV<V> d;
  return hn::Min(hn::Max(x, hn::Zero(d)), hn::Set(d, 1.0f));
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
