// lss/double_lanes-inl.h: pairs of doubles in the lanes of WebAssembly's SIMD128, for which Highway
// 1.0.3 has none: what the kernel uses of them, in Highway's manner. Empty elsewhere. For inclusion
// in sources that Highway compiles once per width.
#if defined(FORETOUCH_LSS_DOUBLE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_LSS_DOUBLE_LANES_INL_H_
#undef FORETOUCH_LSS_DOUBLE_LANES_INL_H_
#else
#define FORETOUCH_LSS_DOUBLE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#if HWY_TARGET == HWY_WASM && !HWY_HAVE_FLOAT64
#include <wasm_simd128.h>

HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {

// Loads, stores, shuffles, selections and what works on bits are Highway's own: they ask only how
// wide a lane is (but for GetLane(), which takes eight bytes for a whole number). Its names for
// what follows (Add(), Lt(), MaxOfLanes()...) call these.
using DoublePair = Vec128<double, 2>;
using DoublePairMask = Mask128<double, 2>;
using DoublePairTag = Simd<double, 2, 0>;
using FloatPairTag = Simd<float, 2, 0>;

HWY_API DoublePair Set(DoublePairTag /* tag */, double x) {
  return {wasm_f64x2_splat(x)};
}
HWY_API DoublePair operator+(DoublePair a, DoublePair b) {
  return {wasm_f64x2_add(a.raw, b.raw)};
}
HWY_API DoublePair operator-(DoublePair a, DoublePair b) {
  return {wasm_f64x2_sub(a.raw, b.raw)};
}
HWY_API DoublePair operator*(DoublePair a, DoublePair b) {
  return {wasm_f64x2_mul(a.raw, b.raw)};
}
HWY_API DoublePair operator/(DoublePair a, DoublePair b) {
  return {wasm_f64x2_div(a.raw, b.raw)};
}
/// Not fused: SIMD128 cannot fuse, and its floats are not fused either.
HWY_API DoublePair MulAdd(DoublePair mul, DoublePair x, DoublePair add) {
  return mul * x + add;
}
HWY_API DoublePair NegMulAdd(DoublePair mul, DoublePair x, DoublePair add) {
  return add - mul * x;
}
HWY_API DoublePair Neg(DoublePair a) {
  return {wasm_f64x2_neg(a.raw)};
}
HWY_API DoublePair Abs(DoublePair a) {
  return {wasm_f64x2_abs(a.raw)};
}
HWY_API DoublePair Sqrt(DoublePair a) {
  return {wasm_f64x2_sqrt(a.raw)};
}
/// a < b ? a : b, and a > b ? a : b, as for floats: with a NaN the result is that of x86-64.
HWY_API DoublePair Min(DoublePair a, DoublePair b) {
  return {wasm_f64x2_pmin(b.raw, a.raw)};
}
HWY_API DoublePair Max(DoublePair a, DoublePair b) {
  return {wasm_f64x2_pmax(b.raw, a.raw)};
}
HWY_API DoublePairMask operator==(DoublePair a, DoublePair b) {
  return {wasm_f64x2_eq(a.raw, b.raw)};
}
HWY_API DoublePairMask operator!=(DoublePair a, DoublePair b) {
  return {wasm_f64x2_ne(a.raw, b.raw)};
}
HWY_API DoublePairMask operator>(DoublePair a, DoublePair b) {
  return {wasm_f64x2_gt(a.raw, b.raw)};
}
HWY_API DoublePairMask operator<=(DoublePair a, DoublePair b) {
  return {wasm_f64x2_le(a.raw, b.raw)};
}
HWY_API DoublePairMask operator>=(DoublePair a, DoublePair b) {
  return {wasm_f64x2_ge(a.raw, b.raw)};
}
HWY_API double GetLane(DoublePair a) {
  return wasm_f64x2_extract_lane(a.raw, 0);
}
HWY_API Vec128<float, 2> DemoteTo(FloatPairTag /* tag */, DoublePair a) {
  return {wasm_f32x4_demote_f64x2_zero(a.raw)};
}
HWY_API DoublePair PromoteTo(DoublePairTag /* tag */, Vec128<float, 2> a) {
  return {wasm_f64x2_promote_low_f32x4(a.raw)};
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#endif
