// tessellation/curve_lanes-inl.h: polynomials through the values at the nodes of a span, in lanes.
// For inclusion in sources that Highway compiles once per width.
#if defined(FORETOUCH_TESSELLATION_CURVE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FORETOUCH_TESSELLATION_CURVE_LANES_INL_H_
#undef FORETOUCH_TESSELLATION_CURVE_LANES_INL_H_
#else
#define FORETOUCH_TESSELLATION_CURVE_LANES_INL_H_
#endif

#include "tessellation/point_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

/// Sum over k of row[k] times the matrix's k-th row, from column `lane` on.
HWY_INLINE NodeVector combined(NodeLanes d, const double* row, const double (*matrix)[kNodes],
                               int from, int lane) {
  NodeVector sum = hn::Mul(hn::Set(d, row[from]), hn::Load(d, matrix[from] + lane));
  for (int k = from + 1; k < kNodes; ++k) {
    sum = hn::MulAdd(hn::Set(d, row[k]), hn::Load(d, matrix[k] + lane), sum);
  }
  return sum;
}

/// Largest norm of the vectors that the rows make of the matrix's columns.
HWY_INLINE double largestNorm(const double (*rows)[kNodes], int count,
                              const double (*matrix)[kNodes], int from) {
  const NodeLanes d;
  NodeVector largest = hn::Zero(d);
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    NodeVector square = hn::Zero(d);
    for (int row = 0; row < count; ++row) {
      const NodeVector x = combined(d, rows[row], matrix, from, lane);
      square = hn::MulAdd(x, x, square);
    }
    largest = hn::Max(largest, square);
  }
  return hn::GetLane(hn::Sqrt(hn::MaxOfLanes(d, largest)));
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
