#include "tessellation/polynomial_matrices.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "lss/extended_precision.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr int kDegree = kNodes - 1;
using Coefficients = std::array<long double, kNodes>;

/// The k-th Chebyshev-Lobatto point of [-1,1], ascending.
long double nodeAt(int k) {
  constexpr long double kPi = 3.14159265358979323846264338327950288L;
  return -std::cos(static_cast<long double>(k) * kPi / kDegree);
}

/// Ascending coefficients of the polynomial that is 1 at node k and 0 at all others.
Coefficients lagrange(int k) {
  Coefficients product{};
  product[0] = 1.0L;
  long double scale = 1.0L;
  for (int other = 0; other < kNodes; ++other) {
    if (other == k) continue;
    const long double root = nodeAt(other);
    for (std::size_t j = kNodes - 1; j > 0; --j) product[j] = product[j - 1] - root * product[j];
    product[0] *= -root;
    scale *= nodeAt(k) - root;
  }
  for (long double& c : product) c /= scale;
  return product;
}

/// Control point `point` of u^power in Bernstein's form of `degree` on [-1,1]: its blossom at
/// `point` ones and `degree - point` minus ones, an elementary symmetric sum over a binomial
/// coefficient.
double controlPoint(int degree, int power, int point) {
  Coefficients symmetric{}, binomial{};
  symmetric[0] = binomial[0] = 1.0L;
  for (int factor = 0; factor < degree; ++factor) {
    const long double argument = factor < point ? 1.0L : -1.0L;
    for (std::size_t j = kNodes - 1; j > 0; --j) {
      symmetric[j] += argument * symmetric[j - 1];
      binomial[j] += binomial[j - 1];
    }
  }
  const auto j = static_cast<std::size_t>(power);
  return static_cast<double>(symmetric[j] / binomial[j]);
}

PolynomialMatrices computed() {
  const ExtendedPrecision digits;
  PolynomialMatrices m{};
  for (int k = 0; k < kNodes; ++k) {
    const Coefficients basis = lagrange(k);
    for (int j = 0; j < kNodes; ++j) {
      m.coefficients[k][j] = static_cast<double>(basis[slotOf(j)]);
    }
  }
  for (int j = 0; j < kNodes; ++j) {
    m.evaluation[j] = 2.0 * j + 2.0;
    for (int point = 0; j >= 1 && point <= kDegree - 1; ++point) {
      m.first[j][point] = j * controlPoint(kDegree - 1, j - 1, point);
    }
    for (int point = 0; j >= 2 && point <= kDegree - 2; ++point) {
      m.second[j][point] = j * (j - 1) * controlPoint(kDegree - 2, j - 2, point);
    }
  }
  return m;
}

}  // namespace

const PolynomialMatrices& polynomialMatrices() {
  static const PolynomialMatrices kMatrices = computed();
  return kMatrices;
}

}  // namespace foretouch::internal
