#include "articulated/chain_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lss/assert.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "articulated/chain_nodes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace foretouch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = HWY_CAPPED(double, kNodes);
using Vector = hn::Vec<Lanes>;

struct Quaternions {
  Vector w, x, y, z;
};

/// The polynomial in `versine` whose coefficients for these lanes are in `rows`, one row of all
/// nodes a power.
HWY_INLINE Vector weights(Lanes d, const double* rows, int terms, Vector versine) {
  Vector sum = hn::Load(d, rows + (terms - 1) * kNodes);
  for (int j = terms - 2; j >= 0; --j) {
    sum = hn::MulAdd(sum, versine, hn::Load(d, rows + j * kNodes));
  }
  return sum;
}

HWY_INLINE Quaternions turned(Lanes d, const JointArc& arc, Vector from, Vector to) {
  const auto at = [&](int i) HWY_ATTR {
    return hn::MulAdd(to, hn::Set(d, arc.to[i]), hn::Mul(from, hn::Set(d, arc.from[i])));
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

HWY_INLINE void storeRotation(Lanes d, const Quaternions& q, int lane, LinkNodes& link) {
  hn::Store(q.w, d, link.q[0] + lane);
  hn::Store(q.x, d, link.q[1] + lane);
  hn::Store(q.y, d, link.q[2] + lane);
  hn::Store(q.z, d, link.q[3] + lane);
  const Vector one = hn::Set(d, 1.0);
  const Vector x2 = hn::Add(q.x, q.x), y2 = hn::Add(q.y, q.y), z2 = hn::Add(q.z, q.z);
  const Vector xy = hn::Mul(q.x, y2), xz = hn::Mul(q.x, z2), yz = hn::Mul(q.y, z2);
  const Vector xx = hn::Mul(q.x, x2), yy = hn::Mul(q.y, y2);
  hn::Store(hn::Sub(one, hn::MulAdd(q.z, z2, yy)), d, link.R[0] + lane);
  hn::Store(hn::NegMulAdd(q.w, z2, xy), d, link.R[1] + lane);
  hn::Store(hn::MulAdd(q.w, y2, xz), d, link.R[2] + lane);
  hn::Store(hn::MulAdd(q.w, z2, xy), d, link.R[3] + lane);
  hn::Store(hn::Sub(one, hn::MulAdd(q.z, z2, xx)), d, link.R[4] + lane);
  hn::Store(hn::NegMulAdd(q.w, x2, yz), d, link.R[5] + lane);
  hn::Store(hn::NegMulAdd(q.w, y2, xz), d, link.R[6] + lane);
  hn::Store(hn::MulAdd(q.w, x2, yz), d, link.R[7] + lane);
  hn::Store(hn::Sub(one, hn::Add(xx, yy)), d, link.R[8] + lane);
}

/// Of a root: in W, relative to `origin`.
HWY_INLINE void storeRootPosition(Lanes d, const JointArc& arc, Vector t, const double* origin,
                                  int lane, LinkNodes& link) {
  for (int i = 0; i < 3; ++i) {
    const Vector start = hn::Set(d, arc.translation[i] - origin[i]);
    hn::Store(hn::MulAdd(t, hn::Set(d, arc.drift[i]), start), d, link.p[i] + lane);
  }
}

HWY_INLINE void storePosition(Lanes d, const JointArc& arc, Vector t, const LinkNodes& parent,
                              int lane, LinkNodes& link) {
  const auto arm = [&](int i) HWY_ATTR {
    return hn::MulAdd(t, hn::Set(d, arc.drift[i]), hn::Set(d, arc.translation[i]));
  };
  const Vector x = arm(0), y = arm(1), z = arm(2);
  for (int i = 0; i < 3; ++i) {
    Vector sum = hn::Load(d, parent.p[i] + lane);
    sum = hn::MulAdd(hn::Load(d, parent.R[3 * i] + lane), x, sum);
    sum = hn::MulAdd(hn::Load(d, parent.R[3 * i + 1] + lane), y, sum);
    sum = hn::MulAdd(hn::Load(d, parent.R[3 * i + 2] + lane), z, sum);
    hn::Store(sum, d, link.p[i] + lane);
  }
}

void evaluateLinks(const JointArc* arcs, int count, const double* fromRows, const double* toRows,
                   int terms, const double* instants, const double* origin, LinkNodes* links) {
  const Lanes d;
  for (int lane = 0; lane < kNodes; lane += static_cast<int>(hn::Lanes(d))) {
    const Vector t = hn::Load(d, instants + lane);
    for (int j = 0; j < count; ++j) {
      const JointArc& arc = arcs[j];
      const Vector versine = hn::Set(d, arc.versine);
      const Quaternions local = turned(d, arc, weights(d, fromRows + lane, terms, versine),
                                       weights(d, toRows + lane, terms, versine));
      if (arc.parent == kNoParent) {
        storeRootPosition(d, arc, t, origin, lane, links[j]);
        storeRotation(d, local, lane, links[j]);
        continue;
      }
      const LinkNodes& parent = links[arc.parent];
      storePosition(d, arc, t, parent, lane, links[j]);
      const Quaternions turn = {hn::Load(d, parent.q[0] + lane), hn::Load(d, parent.q[1] + lane),
                                hn::Load(d, parent.q[2] + lane), hn::Load(d, parent.q[3] + lane)};
      storeRotation(d, product(turn, local), lane, links[j]);
    }
  }
}

}  // namespace foretouch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace foretouch {
namespace {

HWY_EXPORT(evaluateLinks);

/// Unit roundoff of double.
constexpr double kU = 0x1p-53;

// Derived in articulated/chain_nodes.md; tests/articulated/chain_nodes_test.cpp holds them. In
// units of kU.
constexpr double kQuaternion = 96.0;  ///< One joint's quaternion and its product with the parent's.
constexpr double kMatrix = 16.0;      ///< The matrix of a quaternion. Spectral norm.
constexpr double kArm = 16.0;         ///< A translation at t, and a matrix times it.
constexpr double kSum = 10.0;         ///< Adding it to the parent's position.
/// Covers the rounding of the bounds' own arithmetic and products of two errors.
constexpr double kInflation = 1.0 + 1e-9;

/// The longest series: enough for a half turn (versine 1).
constexpr std::size_t kMaxTerms = 56;

/// largestVersine[n]: n terms of the weights' series leave out at most 2^-54 up to here
/// (chain_nodes.md 1).
std::array<double, kMaxTerms + 1> versinesByTerms() {
  constexpr double kLeftOut = 0x1p-55;     // the tail is at most twice its first term
  constexpr double kFirst = 0.1283000599;  // largest t(1-t^2)/3, rounded up
  constexpr double kRoundedDown = 1.0 - 1e-9;
  std::array<double, kMaxTerms + 1> versines{};
  double coefficient = kFirst;
  for (std::size_t n = 1; n <= kMaxTerms; ++n) {
    const auto power = static_cast<double>(n);
    versines[n] = kRoundedDown * std::pow(kLeftOut / coefficient, 1.0 / power);
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
  return kTimes[static_cast<std::size_t>(k)];
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

// The recurrences of articulated/chain_nodes.md section 3.
void ChainNodes::boundRoundings(const ChainMotion& motion) {
  for (LinkId link = 0; link < numLinks_; ++link) {
    const JointArc& arc = motion.arc(link);
    Rounding& bound = roundings_[static_cast<std::size_t>(link)];
    if (arc.parent == kNoParent) {
      double startSquare = 0.0, endSquare = 0.0;
      for (int i = 0; i < 3; ++i) {
        const double start = arc.translation[i] - origin_[i], end = start + arc.drift[i];
        startSquare += start * start;
        endSquare += end * end;
      }
      bound.reach = std::sqrt(std::max(startSquare, endSquare)) * kInflation;
      bound.quaternion = kQuaternion * kU;
      bound.position = kSum * kU * bound.reach * kInflation;
    } else {
      const Rounding& parent = roundings_[static_cast<std::size_t>(arc.parent)];
      bound.reach = (parent.reach + arc.length) * kInflation;
      bound.quaternion = parent.quaternion + kQuaternion * kU;
      bound.position =
          (parent.position + (parent.rotation + kArm * kU) * arc.length + kSum * kU * bound.reach) *
          kInflation;
    }
    bound.rotation = (4.0 * bound.quaternion + kMatrix * kU) * kInflation;
  }
}

void ChainNodes::evaluate(const ChainMotion& motion, double begin, double end,
                          const Eigen::Vector3d& origin) {
  FORETOUCH_ASSERT(0.0 <= begin && begin < end && end <= 1.0);
  numLinks_ = motion.numLinks();
  origin_ = origin;
  const auto n = static_cast<std::size_t>(numLinks_);
  if (nodes_.size() < n) {
    nodes_.resize(n);
    roundings_.resize(n);
  }
  if (n == 0) return;
  setInstants(begin, end);
  const std::size_t terms = termsFor(motion.largestVersine());
  extendWeights(terms);
  HWY_DYNAMIC_DISPATCH(evaluateLinks)
  (&motion.arc(0), numLinks_, weights_.from[0].at, weights_.to[0].at, static_cast<int>(terms),
   instants_, origin_.data(), nodes_.data());
  boundRoundings(motion);
}

}  // namespace foretouch
#endif
