#include "articulated/chain_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "articulated/joint_arcs.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "articulated/chain_nodes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "lss/double_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = HWY_CAPPED(double, kNodes);
using Vector = hn::Vec<Lanes>;

struct Quaternions {
  Vector w, x, y, z;
};

/// Number `column` of joint `joint`, in all lanes.
HWY_INLINE Vector arcAt(Lanes d, internal::JointColumns arcs, int joint, int column) {
  return hn::Set(d, arcs.numbers[column * arcs.stride + joint]);
}

/// The joint's rotation in its parent's frame, from slerp's weights of both ends.
HWY_INLINE Quaternions turned(Lanes d, internal::JointColumns arcs, int joint, Vector from,
                              Vector to) {
  using internal::JointColumns;
  const auto at = [&](int i) HWY_ATTR {
    return hn::MulAdd(to, arcAt(d, arcs, joint, JointColumns::kTo + i),
                      hn::Mul(from, arcAt(d, arcs, joint, JointColumns::kFrom + i)));
  };
  return {at(0), at(1), at(2), at(3)};
}

HWY_INLINE Quaternions product(const Quaternions& a, const Quaternions& b) {
  using hn::Mul;
  using hn::MulAdd;
  using hn::NegMulAdd;
  return {
      NegMulAdd(a.z, b.z, NegMulAdd(a.y, b.y, NegMulAdd(a.x, b.x, Mul(a.w, b.w)))),
      NegMulAdd(a.z, b.y, MulAdd(a.y, b.z, MulAdd(a.x, b.w, Mul(a.w, b.x)))),
      MulAdd(a.z, b.x, MulAdd(a.y, b.w, NegMulAdd(a.x, b.z, Mul(a.w, b.y)))),
      MulAdd(a.z, b.w, NegMulAdd(a.y, b.x, MulAdd(a.x, b.y, Mul(a.w, b.z)))),
  };
}

HWY_INLINE void storeQuaternions(Lanes d, const Quaternions& q, int lane, LinkNodes& link) {
  hn::Store(q.w, d, link.q[0] + lane);
  hn::Store(q.x, d, link.q[1] + lane);
  hn::Store(q.y, d, link.q[2] + lane);
  hn::Store(q.z, d, link.q[3] + lane);
}
HWY_INLINE Quaternions loadQuaternions(Lanes d, const LinkNodes& link, int lane) {
  return {hn::Load(d, link.q[0] + lane), hn::Load(d, link.q[1] + lane),
          hn::Load(d, link.q[2] + lane), hn::Load(d, link.q[3] + lane)};
}

HWY_INLINE void storeMatrices(Lanes d, const Quaternions& q, int lane, LinkNodes& link) {
  using hn::MulAdd;
  using hn::NegMulAdd;
  const Vector one = hn::Set(d, 1.0);
  const Vector x2 = hn::Add(q.x, q.x), y2 = hn::Add(q.y, q.y), z2 = hn::Add(q.z, q.z);
  const Vector xy = hn::Mul(q.x, y2), xz = hn::Mul(q.x, z2), yz = hn::Mul(q.y, z2);
  const Vector withoutX = NegMulAdd(q.x, x2, one), withoutY = NegMulAdd(q.y, y2, one);
  hn::Store(NegMulAdd(q.z, z2, withoutY), d, link.R[0] + lane);
  hn::Store(NegMulAdd(q.w, z2, xy), d, link.R[1] + lane);
  hn::Store(MulAdd(q.w, y2, xz), d, link.R[2] + lane);
  hn::Store(MulAdd(q.w, z2, xy), d, link.R[3] + lane);
  hn::Store(NegMulAdd(q.z, z2, withoutX), d, link.R[4] + lane);
  hn::Store(NegMulAdd(q.w, x2, yz), d, link.R[5] + lane);
  hn::Store(NegMulAdd(q.w, y2, xz), d, link.R[6] + lane);
  hn::Store(MulAdd(q.w, x2, yz), d, link.R[7] + lane);
  hn::Store(NegMulAdd(q.x, x2, withoutY), d, link.R[8] + lane);
}

/// Stores a root's position in W, relative to `origin`.
HWY_INLINE void storeRootPosition(Lanes d, internal::JointColumns arcs, int joint, Vector t,
                                  const double* origin, int lane, LinkNodes& link) {
  using internal::JointColumns;
  for (int i = 0; i < 3; ++i) {
    const Vector start =
        hn::Sub(arcAt(d, arcs, joint, JointColumns::kTranslation + i), hn::Set(d, origin[i]));
    hn::Store(hn::MulAdd(t, arcAt(d, arcs, joint, JointColumns::kDrift + i), start), d,
              link.p[i] + lane);
  }
}

HWY_INLINE void storePosition(Lanes d, internal::JointColumns arcs, int joint, Vector t,
                              const LinkNodes& parent, int lane, LinkNodes& link) {
  using internal::JointColumns;
  Vector arm[3];
  for (int i = 0; i < 3; ++i) arm[i] = arcAt(d, arcs, joint, JointColumns::kTranslation + i);
  const double* const driftLength = arcs.numbers + JointColumns::kDriftLength * arcs.stride + joint;
  if (*driftLength != 0.0) {
    for (int i = 0; i < 3; ++i) {
      arm[i] = hn::MulAdd(t, arcAt(d, arcs, joint, JointColumns::kDrift + i), arm[i]);
    }
  }
  for (int i = 0; i < 3; ++i) {
    Vector sum = hn::Load(d, parent.p[i] + lane);
    for (int k = 0; k < 3; ++k) {
      sum = hn::MulAdd(hn::Load(d, parent.R[3 * i + k] + lane), arm[k], sum);
    }
    hn::Store(sum, d, link.p[i] + lane);
  }
}

/// Joints whose series we sum side by side: one alone would wait for its own sums.
constexpr int kJointsAbreast = 4;

/// The polynomials in `versines` whose coefficients for these lanes are in `rows`, one row of all
/// nodes per power.
HWY_INLINE void weights(Lanes d, const double* rows, int terms, const Vector* versines,
                        Vector* sums) {
  const Vector last = hn::Load(d, rows + (terms - 1) * kNodes);
  for (int i = 0; i < kJointsAbreast; ++i) sums[i] = last;
  for (int k = terms - 2; k >= 0; --k) {
    const Vector row = hn::Load(d, rows + k * kNodes);
    for (int i = 0; i < kJointsAbreast; ++i) sums[i] = hn::MulAdd(sums[i], versines[i], row);
  }
}

/// Leaves slerp's weights of `from` and `to` in q[0] and q[1] of all links. If the instants are
/// those of [0,1], the series of `from` is that of `to` backwards: `fromRows` is null.
void weighJoints(internal::JointColumns arcs, const double* fromRows, const double* toRows,
                 int terms, LinkNodes* links) {
  const Lanes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int first = 0; first < arcs.stride; first += kJointsAbreast) {
    Vector versines[kJointsAbreast], sums[kJointsAbreast];
    LinkNodes* abreast[kJointsAbreast];
    for (int i = 0; i < kJointsAbreast; ++i) {
      // Places beyond the last joint repeat it.
      const int joint = first + i < arcs.stride ? first + i : arcs.stride - 1;
      abreast[i] = links + joint;
      versines[i] = arcAt(d, arcs, joint, internal::JointColumns::kVersine);
    }
    for (int lane = 0; lane < kNodes; lane += lanes) {
      weights(d, toRows + lane, terms, versines, sums);
      for (int i = 0; i < kJointsAbreast; ++i) {
        hn::Store(sums[i], d, abreast[i]->q[1] + lane);
        if (fromRows != nullptr) continue;
        hn::Store(hn::Reverse(d, sums[i]), d, abreast[i]->q[0] + (kNodes - lanes - lane));
      }
      if (fromRows == nullptr) continue;
      weights(d, fromRows + lane, terms, versines, sums);
      for (int i = 0; i < kJointsAbreast; ++i) hn::Store(sums[i], d, abreast[i]->q[0] + lane);
    }
  }
}

void evaluateLinks(internal::JointColumns arcs, const JointId* parents, const double* fromRows,
                   const double* toRows, int terms, const double* instants, const double* origin,
                   LinkNodes* links) {
  const Lanes d;
  weighJoints(arcs, fromRows, toRows, terms, links);
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    const Vector t = hn::Load(d, instants + lane);
    for (int j = 0; j < arcs.stride; ++j) {
      LinkNodes& link = links[j];
      Quaternions q =
          turned(d, arcs, j, hn::Load(d, link.q[0] + lane), hn::Load(d, link.q[1] + lane));
      if (parents[j] == kNoParent) {
        storeRootPosition(d, arcs, j, t, origin, lane, link);
      } else {
        const LinkNodes& parent = links[parents[j]];
        storePosition(d, arcs, j, t, parent, lane, link);
        q = product(loadQuaternions(d, parent, lane), q);
      }
      storeQuaternions(d, q, lane, link);
      storeMatrices(d, q, lane, link);
    }
  }
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(evaluateLinks);

/// Bound on the rest of the weights' series: far below the rounding of floats, and each bit takes
/// time.
constexpr double kLeftOut = 0x1p-44;

// Derived in articulated/chain_nodes.md; tests/articulated/chain_nodes_test.cpp checks them.
constexpr double kQuaternion =
    96.0 * kUnitRoundoff +
    2.0 * kLeftOut;  ///< One joint's quaternion and its product with the parent's.
constexpr double kMatrix = 16.0 * kUnitRoundoff;  ///< The matrix of a quaternion. Spectral norm.
constexpr double kArm = 16.0 * kUnitRoundoff;     ///< A translation at t, and a matrix times it.
constexpr double kSum = 10.0 * kUnitRoundoff;     ///< Adding it to the parent's position.
/// Covers the rounding of the bounds' own arithmetic and products of two errors.
constexpr double kNodeInflation = 1.0 + 1e-9;

/// The longest series: enough for a half turn (versine 1).
constexpr std::size_t kMaxTerms = 46;

/// largestVersine[n]: n terms of the weights' series leave out at most kLeftOut up to here
/// (chain_nodes.md 1).
std::array<double, kMaxTerms + 1> versinesByTerms() {
  constexpr double kFirst = 0.1283000599;  // largest t(1-t^2)/3, rounded up
  constexpr double kRoundedDown = 1.0 - 1e-9;
  std::array<double, kMaxTerms + 1> versines{};
  double coefficient = kFirst;
  // The terms after the first omitted one are together at most as large.
  for (std::size_t n = 1; n <= kMaxTerms; ++n) {
    const auto power = static_cast<double>(n);
    versines[n] = kRoundedDown * std::pow(0.5 * kLeftOut / coefficient, 1.0 / power);
    coefficient *= (power + 1.0) / (2.0 * power + 3.0);
  }
  return versines;
}

std::size_t termsFor(double versine) {
  static const std::array<double, kMaxTerms + 1> kVersines = versinesByTerms();
  std::size_t terms = 1;
  while (terms < kMaxTerms && kVersines[terms] < versine) ++terms;
  FORETOUCH_ASSERT(kVersines[terms] >= versine);
  return terms;
}

/// The coefficients of sin(s*phi)/sin(phi) for the power of 1 - cos(phi) after `power`, one for
/// each s (chain_nodes.md 1).
void nextCoefficients(const double* s, const double* coefficients, std::size_t power,
                      double* next) {
  const auto j = static_cast<double>(power);
  const double inverse = 1.0 / ((2.0 * j + 3.0) * (j + 1.0));
  for (int k = 0; k < kNodes; ++k) {
    next[k] = coefficients[k] * (((j + 1.0) - s[k]) * ((j + 1.0) + s[k]) * inverse);
  }
}

}  // namespace

double ChainNodes::time(int k) {
  // (1 - cos(k pi/7))/2, nearest doubles; tested against fifty digits.
  static constexpr std::array<double, kNodes> kTimes = {0.0,
                                                        0.049515566048790434,
                                                        0.18825509907063323,
                                                        0.3887395330218428,
                                                        0.6112604669781572,
                                                        0.8117449009293668,
                                                        0.9504844339512095,
                                                        1.0};
  return kTimes[slotOf(k)];
}

void ChainNodes::posesAt(const ChainMotion& motion, double begin, double end, Pose& from,
                         Pose& to) {
  using internal::JointColumns;
  const auto n = static_cast<std::size_t>(motion.numLinks());
  const double* const arcs = motion.arcs_.data();
  const double instants[2] = {begin, end};
  Pose* const poses[2] = {&from, &to};
  // Weights of both ends, at both instants; the other lanes mean nothing.
  alignas(64) double coefficients[kMaxTerms][kNodes] = {{1.0 - begin, begin, 1.0 - end, end}};
  const std::size_t terms = termsFor(motion.largestVersine());
  for (std::size_t i = 1; i < terms; ++i) {
    nextCoefficients(coefficients[0], coefficients[i - 1], i - 1, coefficients[i]);
  }
  for (Pose* const pose : poses) {
    pose->rotations.resize(n);
    pose->translations.resize(n);
  }
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = [&](int column) { return arcs[static_cast<std::size_t>(column) * n + j]; };
    const double versine = at(JointColumns::kVersine);
    double weights[4] = {};
    for (std::size_t i = terms; i > 0; --i) {
      for (std::size_t k = 0; k < 4; ++k)
        weights[k] = weights[k] * versine + coefficients[i - 1][k];
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const double t = instants[i];
      // The ends as they are given.
      const double ofFrom = t == 0.0 ? 1.0 : t == 1.0 ? 0.0 : weights[2 * i];
      const double ofTo = t == 0.0 ? 0.0 : t == 1.0 ? 1.0 : weights[2 * i + 1];
      double q[4], square = 0.0;
      for (int k = 0; k < 4; ++k) {
        q[k] = ofFrom * at(JointColumns::kFrom + k) + ofTo * at(JointColumns::kTo + k);
        square += q[k] * q[k];
      }
      const double scale = t == 0.0 || t == 1.0 ? 1.0 : 1.0 / std::sqrt(square);
      poses[i]->rotations[j] = Quaternion(q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale);
      for (int k = 0; k < 3; ++k) {
        poses[i]->translations[j][k] =
            at(JointColumns::kTranslation + k) + t * at(JointColumns::kDrift + k);
      }
    }
  }
}

void ChainNodes::setInstants(double begin, double end) {
  if (begin == begin_ && end == end_) return;
  begin_ = begin;
  end_ = end;
  for (int k = 0; k < kNodes; ++k) {
    instants_[k] = k == kNodes - 1 ? end : begin + (end - begin) * time(k);
  }
  weights_.from.clear();
  weights_.to.clear();
}

void ChainNodes::extendWeights(std::size_t terms) {
  if (weights_.to.empty()) {
    weights_.from.reserve(kMaxTerms);
    weights_.to.reserve(kMaxTerms);
    weights_.from.emplace_back();
    weights_.to.emplace_back();
    for (std::size_t k = 0; k < kNodes; ++k) {
      weights_.from[0].at[k] = 1.0 - instants_[k];
      weights_.to[0].at[k] = instants_[k];
    }
  }
  for (std::size_t j = weights_.to.size(); j < terms; ++j) {
    weights_.from.emplace_back();
    weights_.to.emplace_back();
    nextCoefficients(weights_.from[0].at, weights_.from[j - 1].at, j - 1, weights_.from[j].at);
    nextCoefficients(weights_.to[0].at, weights_.to[j - 1].at, j - 1, weights_.to[j].at);
  }
}

/// Bound on the distance of the roots from `origin` at any t.
double ChainNodes::rootReach(const ChainMotion& motion) const {
  const auto stride = static_cast<std::size_t>(motion.numLinks());
  double square = 0.0;
  for (std::size_t j = 0; j < stride; ++j) {
    if (motion.parents_[j] != kNoParent) continue;
    double startSquare = 0.0, endSquare = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double translation =
          motion.arcs_[(internal::JointColumns::kTranslation + i) * stride + j];
      const double drift = motion.arcs_[(internal::JointColumns::kDrift + i) * stride + j];
      const double start = translation - origin_[static_cast<int>(i)], end = start + drift;
      startSquare += start * start;
      endSquare += end * end;
    }
    square = std::max({square, startSquare, endSquare});
  }
  return std::sqrt(square);
}

// articulated/chain_nodes.md 3.
void ChainNodes::boundRoundings(const ChainMotion& motion, const ChainMotion& beside) {
  const ChainSums &own = motion.largestSums(), &others = beside.largestSums();
  const double depth = std::max(own.depth, others.depth);
  const double arm = std::max(own.armReach, others.armReach);
  const double rotation = 4.0 * depth * kQuaternion + kMatrix;
  double root = rootReach(motion);
  if (&beside != &motion) root = std::max(root, rootReach(beside));
  bounds_.reach = (root + arm) * kNodeInflation;
  bounds_.rotationRounding = rotation * kNodeInflation;
  bounds_.positionRounding =
      ((rotation + kArm) * arm + depth * kSum * bounds_.reach) * kNodeInflation;
}

void ChainNodes::evaluate(const ChainMotion& motion, double begin, double end,
                          const Eigen::Vector3d& origin, const ChainMotion* beside) {
  FORETOUCH_ASSERT(0.0 <= begin && begin < end && end <= 1.0);
  numLinks_ = motion.numLinks();
  origin_ = origin;
  const auto n = static_cast<std::size_t>(numLinks_);
  if (nodes_.size() < n) nodes_.resize(n);
  if (n == 0) return;
  setInstants(begin, end);
  const ChainMotion& second = beside != nullptr ? *beside : motion;
  const std::size_t terms = termsFor(std::max(motion.largestVersine(), second.largestVersine()));
  extendWeights(terms);
  const bool isWhole = begin == 0.0 && end == 1.0;
  // Only read.
  const internal::JointColumns arcs = {const_cast<double*>(motion.arcs_.data()), numLinks_};
  HWY_DYNAMIC_DISPATCH(evaluateLinks)
  (arcs, motion.parents_.data(), isWhole ? nullptr : weights_.from[0].at, weights_.to[0].at,
   static_cast<int>(terms), instants_, origin_.data(), nodes_.data());
  boundRoundings(motion, second);
}

}  // namespace foretouch
#endif
