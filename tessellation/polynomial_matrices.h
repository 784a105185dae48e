// tessellation/polynomial_matrices.h: the matrices from a curve's values at the eight
// Chebyshev-Lobatto points of [-1,1] to its coefficients, and from these to the control points that
// bound its derivatives. Derived in tessellation/lss_polynomials.md 3.
#pragma once

#include "articulated/chain_nodes.h"

namespace foretouch::internal {

struct alignas(64) PolynomialMatrices {
  double coefficients[kNodes][kNodes];  ///< [node][power of u].
  /// [power of u][control point] of the first and second derivative in Bernstein's form of degree 6
  /// and 5 on [-1,1]; unused columns are zero.
  double first[kNodes][kNodes], second[kNodes][kNodes];
  double evaluation[kNodes];  ///< [power of u]: the roundings it meets, 2j + 2.
};

// What polynomials through the nodes lose, in double (lss_polynomials.md 3).
inline constexpr double kInstantRounding =
    0x1p-52;                              ///< How far a node's instant is from the formula's, in t.
inline constexpr double kLebesgue = 2.5;  ///< Errors at the nodes grow by at most this in between.
inline constexpr double kFitting = 4096.0;  ///< The coefficients' rounding, in u of weighted.
inline constexpr double kControlRounding = 1e-13;  ///< The control points', as a share of weighted.

/// Computed on first use; nearest doubles but for a few roundings of long double.
[[nodiscard]] const PolynomialMatrices& polynomialMatrices();

}  // namespace foretouch::internal
