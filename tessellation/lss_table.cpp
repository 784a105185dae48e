#include "tessellation/lss_table.h"

#include <algorithm>
#include <cmath>

#include "articulated/chain_nodes.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

using internal::kInflation;

/// Bounds |product of (u - u_k)| / 8! over u in [-1,1], u_k the eight Chebyshev-Lobatto points: the
/// product is sin(x)*sin(7x)/64 at u = cos(x) (lss_polynomials.md 1).
constexpr double kNodePolynomial = 1.0 / (64.0 * 40320.0);

/// The interpolation error over a span of t, per unit of the eighth derivative by t.
double errorPerDerivative(double span) {
  // d/dx is span/2 times d/dt, x being the parameter in [-1,1].
  const double half = 0.5 * span, square = half * half, fourth = square * square;
  return kNodePolynomial * fourth * fourth * kInflation;
}

LssTable::Entry entryOf(const Lss& lss, LinkId link) {
  LssTable::Entry entry{};
  for (int i = 0; i < 3; ++i) {
    entry.a[i] = lss.a[i];
    entry.b[i] = lss.b[i];
  }
  entry.radius = lss.radius;
  entry.rhoA = lss.a.norm() * kInflation;
  entry.rhoB = lss.b.norm() * kInflation;
  entry.link = link;
  return entry;
}

}  // namespace

LssTable::LssTable(const Avatar& avatar) {
  entries_.reserve(countOf(avatar.numLss()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) add(avatar.lss(link));
}

void LssTable::assign(const std::vector<std::vector<Lss>>& lssPerLink) {
  entries_.clear();
  first_.assign(1, 0);
  rho_.clear();
  bareLinks_.clear();
  largestRho_ = largestRadius_ = 0.0;
  for (const std::vector<Lss>& lss : lssPerLink) add(lss);
}

/// Adds the LSS of the next link.
void LssTable::add(const std::vector<Lss>& lssOfLink) {
  const LinkId link = numLinks();
  double rho = 0.0;
  for (const Lss& lss : lssOfLink) {
    entries_.push_back(entryOf(lss, link));
    rho = std::max({rho, entries_.back().rhoA, entries_.back().rhoB});
    largestRadius_ = std::max(largestRadius_, lss.radius);
  }
  if (lssOfLink.empty()) bareLinks_.push_back(link);
  rho_.push_back(rho);
  largestRho_ = std::max(largestRho_, rho);
  first_.push_back(size());
}

double interpolationError(const MotionBounds& bounds, double rho, double span) {
  return bounds.eighthDerivativeAt(rho) * errorPerDerivative(span);
}

int slabsFor(const LssTable& table, const ChainMotion& motion, double wantedError) {
  constexpr int kMostSlabs = 16;
  constexpr double kHalving = 256.0;  // the eighth power of two
  // Most steps are slow enough that one bound on all links suffices.
  double derivative = motion.largestSums().bounds().eighthDerivativeAt(table.largestRho());
  if (derivative * errorPerDerivative(1.0) > wantedError) {
    derivative = 0.0;
    for (LinkId link = 0; link < table.numLinks(); ++link) {
      if (table.first(link) == table.first(link + 1)) continue;
      derivative = std::max(derivative, motion.bounds(link).eighthDerivativeAt(table.rho(link)));
    }
  }
  double error = derivative * errorPerDerivative(1.0);
  int slabs = 1;
  while (slabs < kMostSlabs && error > wantedError) {
    slabs *= 2;
    error /= kHalving;
  }
  return slabs;
}

}  // namespace foretouch
