#include "articulated/joint_arcs.h"

#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "articulated/joint_arcs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lss/double_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::internal::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
/// Wider vectors spend more on reordering than they save.
constexpr int kMostLanes = 4;
using Lanes = HWY_CAPPED(double, kMostLanes);
using Vector = hn::Vec<Lanes>;

/// A quaternion whose computed square is this close to 1 stays as given.
constexpr double kNormSquareError = 16.0 * kUnitRoundoff;
/// asin(c/2)*2 <= c*(1 + kArcExcess*c^2) for 0 <= c <= sqrt(2) and a little beyond
/// (motion_bounds.md 2).
constexpr double kArcExcess = 0.0556;
/// The angle from the chord, and the computed rate (rad).
constexpr double kChordRate = 128.0 * kUnitRoundoff;
/// Takes roots in float and rounds them up: 2^-24 of the root for its own rounding, half as much
/// for its argument's, and next to nothing for the few operations in double around it.
constexpr double kRootInflation = 1.0 + 0x1p-23;
/// Arguments below the least normal float (1.2e-38) may become zero: their roots are below this.
constexpr double kLeastRoot = 1.1e-19;

/// x, y, z, w of as many joints as there are lanes.
struct Quaternions {
  Vector x, y, z, w;
};
struct Vectors {
  Vector x, y, z;
};

// Products and sums are rounded one by one, never fused: the sign of a dot product is part of the
// motion's definition, and every width must find the same arcs.

/// Summed in the order w, x, y, z, as motion.h has it.
HWY_INLINE Vector dot(const Quaternions& a, const Quaternions& b) {
  using hn::Add;
  using hn::Mul;
  return Add(Add(Add(Mul(a.w, b.w), Mul(a.x, b.x)), Mul(a.y, b.y)), Mul(a.z, b.z));
}
HWY_INLINE Vector squareOf(const Vectors& v) {
  return hn::Add(hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y)), hn::Mul(v.z, v.z));
}
/// At least the root, and hardly more: good enough for bounds, and roots of doubles take four times
/// as long. Arguments are at most 3e38.
HWY_INLINE Vector rootAbove(Lanes d, Vector square) {
  const hn::Rebind<float, Lanes> floats;
  const Vector root = hn::PromoteTo(d, hn::Sqrt(hn::DemoteTo(floats, square)));
  return hn::Add(hn::Mul(root, hn::Set(d, kRootInflation)), hn::Set(d, kLeastRoot));
}
HWY_INLINE Quaternions difference(const Quaternions& a, const Quaternions& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z), hn::Sub(a.w, b.w)};
}
HWY_INLINE Quaternions scaled(const Quaternions& q, Vector factor) {
  return {hn::Mul(q.x, factor), hn::Mul(q.y, factor), hn::Mul(q.z, factor), hn::Mul(q.w, factor)};
}

/// A validated pose's quaternions are unit within 12 u and stay as given.
HWY_INLINE Quaternions unit(Lanes d, const Quaternions& q) {
  const Vector one = hn::Set(d, 1.0);
  const Vector square = dot(q, q);
  const auto isUnit = hn::Le(hn::Abs(hn::Sub(square, one)), hn::Set(d, kNormSquareError));
  if (HWY_LIKELY(hn::AllTrue(d, isUnit))) return q;
  return scaled(q, hn::IfThenElse(isUnit, one, hn::Div(one, hn::Sqrt(square))));
}

HWY_INLINE Quaternions loadQuaternions(Lanes d, const double* rotations) {
  Quaternions q;
  hn::LoadInterleaved4(d, rotations, q.x, q.y, q.z, q.w);
  return q;
}
HWY_INLINE Vectors loadVectors(Lanes d, const double* translations) {
  Vectors v;
  hn::LoadInterleaved3(d, translations, v.x, v.y, v.z);
  return v;
}

/// Four columns from `column` on.
HWY_INLINE void store(Lanes d, const Quaternions& q, JointColumns arcs, int column, int at) {
  double* const first = arcs.numbers + column * arcs.stride + at;
  hn::StoreU(q.w, d, first);
  hn::StoreU(q.x, d, first + arcs.stride);
  hn::StoreU(q.y, d, first + 2 * arcs.stride);
  hn::StoreU(q.z, d, first + 3 * arcs.stride);
}
/// Three columns from `column` on.
HWY_INLINE void store(Lanes d, const Vectors& v, JointColumns arcs, int column, int at) {
  double* const first = arcs.numbers + column * arcs.stride + at;
  hn::StoreU(v.x, d, first);
  hn::StoreU(v.y, d, first + arcs.stride);
  hn::StoreU(v.z, d, first + 2 * arcs.stride);
}
HWY_INLINE void store(Lanes d, Vector v, JointColumns arcs, int column, int at) {
  hn::StoreU(v, d, arcs.numbers + column * arcs.stride + at);
}

HWY_INLINE void turns(Lanes d, const StepPoses& poses, int at, JointColumns arcs) {
  const Quaternions from = loadQuaternions(d, poses.rotations[0] + 4 * at);
  Quaternions to = loadQuaternions(d, poses.rotations[1] + 4 * at);
  const Vector zero = hn::Zero(d), one = hn::Set(d, 1.0);
  // The quaternions as given decide, before a norm rounds.
  const Vector sign = hn::IfThenElse(hn::Lt(dot(from, to), zero), hn::Neg(one), one);
  const Quaternions start = unit(d, from);
  to = scaled(unit(d, to), sign);
  store(d, start, arcs, JointColumns::kFrom, at);
  store(d, to, arcs, JointColumns::kTo, at);
  const Quaternions chord = difference(to, start);
  const Vector square = dot(chord, chord);
  const Vector excess = hn::Add(one, hn::Mul(hn::Set(d, kArcExcess), square));
  const Vector length = rootAbove(d, square);
  const Vector twice = hn::Add(length, length);
  store(d, hn::Mul(hn::Set(d, 0.5), square), arcs, JointColumns::kVersine, at);
  store(d, hn::Add(hn::Mul(twice, excess), hn::Set(d, kChordRate)), arcs, JointColumns::kTurn, at);
}

HWY_INLINE void shifts(Lanes d, const StepPoses& poses, int at, JointColumns arcs) {
  const Vectors start = loadVectors(d, poses.translations[0] + 3 * at);
  const Vectors end = loadVectors(d, poses.translations[1] + 3 * at);
  const Vectors drift = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y), hn::Sub(end.z, start.z)};
  store(d, start, arcs, JointColumns::kTranslation, at);
  store(d, drift, arcs, JointColumns::kDrift, at);
  Vector square = squareOf(start), driftLength = hn::Zero(d);
  const Vector moved = hn::Add(hn::Add(hn::Abs(drift.x), hn::Abs(drift.y)), hn::Abs(drift.z));
  // Most joints keep their distance from the parent's.
  const auto isStill = hn::Eq(moved, hn::Zero(d));
  if (!hn::AllTrue(d, isStill)) {
    const Vectors last = {hn::Add(start.x, drift.x), hn::Add(start.y, drift.y),
                          hn::Add(start.z, drift.z)};
    // A norm is convex along a line: its largest value is at an end.
    square = hn::Max(square, squareOf(last));
    driftLength = hn::IfThenZeroElse(isStill, rootAbove(d, squareOf(drift)));
  }
  store(d, rootAbove(d, square), arcs, JointColumns::kLength, at);
  store(d, driftLength, arcs, JointColumns::kDriftLength, at);
}

/// Joints that do not fill a vector; repeats the last one.
void computeFewArcs(const StepPoses& poses, int joints, JointColumns arcs) {
  const Lanes d;
  double numbers[2][kMostLanes * 4], places[2][kMostLanes * 3];
  StepPoses padded;
  for (int pose = 0; pose < 2; ++pose) {
    for (int j = 0; j < kMostLanes; ++j) {
      const int joint = j < joints ? j : joints - 1;
      for (int i = 0; i < 4; ++i) {
        numbers[pose][4 * j + i] = poses.rotations[pose][4 * joint + i];
      }
      for (int i = 0; i < 3; ++i) {
        places[pose][3 * j + i] = poses.translations[pose][3 * joint + i];
      }
    }
    padded.rotations[pose] = numbers[pose];
    padded.translations[pose] = places[pose];
  }
  double computed[JointColumns::kCount * kMostLanes];
  const JointColumns paddedArcs = {computed, kMostLanes};
  turns(d, padded, 0, paddedArcs);
  shifts(d, padded, 0, paddedArcs);
  for (int column = 0; column < JointColumns::kCount; ++column) {
    for (int j = 0; j < joints; ++j) {
      arcs.numbers[column * arcs.stride + j] = computed[column * kMostLanes + j];
    }
  }
}

void arcsInLanes(const StepPoses& poses, int joints, JointColumns arcs) {
  const Lanes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  if (joints < lanes) {
    computeFewArcs(poses, joints, arcs);
    return;
  }
  for (int first = 0; first < joints; first += lanes) {
    // The last vector repeats joints of the one before it.
    const int at = first + lanes <= joints ? first : joints - lanes;
    turns(d, poses, at, arcs);
    shifts(d, poses, at, arcs);
  }
}

}  // namespace foretouch::internal::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch::internal {
namespace {
HWY_EXPORT(arcsInLanes);
}  // namespace

void computeArcs(const StepPoses& poses, int joints, JointColumns arcs) {
  HWY_DYNAMIC_DISPATCH(arcsInLanes)(poses, joints, arcs);
}

}  // namespace foretouch::internal
#endif
