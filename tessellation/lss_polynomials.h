// tessellation/lss_polynomials.h: the motion of an LSS and of a frame over a span, as certified
// polynomials: single precision for the lanes that use them, with every error (of interpolation,
// rounding and evaluation) proved in tessellation/lss_polynomials.md and included. Metres. Source:
// [Kim07] for the tessellated sweep of an LSS. Not installed.
#pragma once

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "tessellation/lss_table.h"

namespace foretouch {

/// Coefficients of a polynomial through the values at kNodes instants.
inline constexpr int kCoefficients = kNodes;

/// One LSS over a span, by polynomials in u = 2(t - begin)/(end - begin) - 1 in [-1,1]. Promise:
/// for every float u in [-1,1], every point of the true LSS at the instant of u is within `radius`
/// of the segment from a(u) to b(u), both evaluated in float by Horner's rule (fused or not), plus
/// `origin` in exact arithmetic, plus the origin of the nodes. No stricter alignment than its
/// members': GCC 12 gives the temporary of `x = f()` the stack's own 16 bytes, whatever the type
/// requires.
struct LssPolynomials {
  float a[3][kCoefficients], b[3][kCoefficients];  ///< Ascending powers of u; relative to `origin`.
  double origin[3];      ///< Relative to the origin of the nodes; every coordinate is a float.
  float radius;          ///< The LSS's, plus all uncertainty; rounded up.
  float speedA, speedB;  ///< Bounds on |d/du| of the polynomials a, b on [-1,1]; rounded up.
  float accelerationA, accelerationB;  ///< Bounds on |d^2/du^2| of them; rounded up.
  float weighted;  ///< The larger sum over j of (2j+2) |j-th coefficient|; rounded up.
};

/// `nodes` are those of `motion`. O(1).
[[nodiscard]] LssPolynomials polynomialsOf(const LssTable::Entry& entry, const ChainMotion& motion,
                                           const ChainNodes& nodes);

/// One link's frame over a span, by polynomials in u as above, for points fixed in the link.
/// Promise: for every float u in [-1,1] and every point p_L of the link, |true - evaluated| <=
/// originError + rotationError*|p_L|, where `evaluated` is p(u) + R(u)*p_L in float: Horner's rule,
/// p_L rounded to float, products and sums in any order, fused or not; plus `origin` in exact
/// arithmetic.
struct FramePolynomials {
  float R[9][kCoefficients];  ///< Row after row.
  float p[3][kCoefficients];  ///< Relative to `origin`.
  double origin[3];           ///< Relative to the origin of the nodes; every coordinate is a float.
  float originError, rotationError;  ///< Rounded up.
  /// Bounds on |d/du| and |d^2/du^2| of p and, in spectral norm, of R on [-1,1]. A point at
  /// distance rho has at most originSpeed + rotationSpeed*rho, and so on. Rounded up.
  float originSpeed, rotationSpeed, originAcceleration, rotationAcceleration;
};

[[nodiscard]] FramePolynomials framePolynomialsOf(LinkId link, const ChainMotion& motion,
                                                  const ChainNodes& nodes);
/// The same relative to a given `origin`, of another link's polynomials. Coarser the farther away
/// it is.
[[nodiscard]] FramePolynomials framePolynomialsOf(LinkId link, const ChainMotion& motion,
                                                  const ChainNodes& nodes, const double* origin);

}  // namespace foretouch
