// tessellation/lss_polynomials.h: what an avatar's LSS cover while they move, as certified boxes
// and certified polynomials: single precision for the lanes that use them, with every error (of
// interpolation, of rounding, of evaluation) proved in tessellation/lss_polynomials.md and counted
// into radii and boxes. Metres. Source: [Kim07] for the tessellated sweep of an LSS.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "lss/lss.h"

namespace foretouch {

/// Coefficients of a polynomial through the values at kNodes instants.
inline constexpr int kCoefficients = kNodes;

/// All LSS of an avatar in link order, with what every step asks of them. Immutable.
class LssTable {
 public:
  struct Entry {
    Lss lss;
    LinkId link = -1;
    double rhoA = 0.0, rhoB = 0.0;  ///< |a| and |b|, rounded up.
  };

  LssTable() = default;
  explicit LssTable(const Avatar& avatar);

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(entries_.size()); }
  [[nodiscard]] const Entry& operator[](std::int32_t lss) const {
    return entries_[static_cast<std::size_t>(lss)];
  }
  /// The link's LSS are [first(link), first(link + 1)).
  [[nodiscard]] std::int32_t first(LinkId link) const {
    return first_[static_cast<std::size_t>(link)];
  }
  [[nodiscard]] std::int32_t numLinks() const {
    return static_cast<std::int32_t>(first_.size()) - 1;
  }
  /// Largest rhoA or rhoB of the link's LSS; 0 where it has none.
  [[nodiscard]] double rho(LinkId link) const { return rho_[static_cast<std::size_t>(link)]; }

 private:
  std::vector<Entry> entries_;
  std::vector<std::int32_t> first_{0};
  std::vector<double> rho_;
};

/// Bound on the distance of a link's point at distance `rho` from the link's origin to the
/// polynomial of degree 7 through its positions at the nodes of a span of length `span` (of t):
/// interpolation alone, in exact arithmetic.
[[nodiscard]] double interpolationError(const MotionBounds& bounds, double rho, double span);

/// The least of 1, 2, 4, 8, 16 equal spans of [0,1] for which interpolationError() of every LSS is
/// at most `wantedError` (m); 16 where none is. O(links).
[[nodiscard]] int slabsFor(const LssTable& table, const ChainMotion& motion, double wantedError);

/// One LSS over a span, by polynomials in u = 2(t - begin)/(end - begin) - 1 in [-1,1].
/// Promise: for every float u in [-1,1], every point of the true LSS at the instant that u stands
/// for is within `radius` of the segment from a(u) to b(u), these as evaluated in float by Horner's
/// rule (fused or not), plus `origin` in exact arithmetic, plus the origin of the nodes.
struct alignas(64) LssPolynomials {
  float a[3][kCoefficients], b[3][kCoefficients];  ///< Ascending powers of u; relative to `origin`.
  double origin[3];      ///< Relative to the origin of the nodes; every coordinate is a float.
  float radius;          ///< The LSS's, and all that is uncertain; rounded up.
  float speedA, speedB;  ///< On |d/du| of the polynomials a, b on [-1,1]; rounded up.
  float accelerationA, accelerationB;  ///< On |d^2/du^2| of the polynomials; rounded up.
};

/// `nodes` were evaluated of `motion`. O(1).
[[nodiscard]] LssPolynomials polynomialsOf(const LssTable::Entry& entry, const ChainMotion& motion,
                                           const ChainNodes& nodes);

/// One link's frame over a span, by polynomials in u as above, for points fixed in the link.
/// Promise: for every float u in [-1,1] and every point p_L of the link, |true - evaluated| <=
/// originError + rotationError*|p_L|, where `evaluated` is p(u) + R(u)*p_L in float: Horner's rule,
/// p_L rounded to float, products and sums in any order, fused or not; plus `origin` in exact
/// arithmetic.
struct alignas(64) FramePolynomials {
  float R[9][kCoefficients];  ///< Row after row.
  float p[3][kCoefficients];  ///< Relative to `origin`.
  double origin[3];           ///< Relative to the origin of the nodes; every coordinate is a float.
  float originError, rotationError;  ///< Rounded up.
  /// On |d/du| and |d^2/du^2| of the polynomials on [-1,1]: p's, and R's in spectral norm; a point
  /// at distance rho has at most originSpeed + rotationSpeed*rho, and so on. Rounded up.
  float originSpeed, rotationSpeed, originAcceleration, rotationAcceleration;
};

[[nodiscard]] FramePolynomials framePolynomialsOf(LinkId link, const ChainMotion& motion,
                                                  const ChainNodes& nodes);

/// Boxes of floats, one lane an LSS in the table's order, as structure of arrays. Lanes from
/// `count` to `capacity` are empty boxes (lower +inf, upper -inf). Memory is kept.
struct SweptBoxes {
  static constexpr std::int32_t kPadding = 16;  ///< Capacity is a multiple of it.
  std::int32_t count = 0, capacity = 0;
  float* lower[3] = {nullptr, nullptr, nullptr};  ///< [axis][lss], each aligned to 64 bytes.
  float* upper[3] = {nullptr, nullptr, nullptr};

  SweptBoxes() = default;
  SweptBoxes(const SweptBoxes&) = delete;
  SweptBoxes& operator=(const SweptBoxes&) = delete;
  void resize(std::int32_t newCount);

 private:
  std::vector<float> storage_;
};

/// The float box of every LSS over the whole span of `nodes`, grown by `margin` (m), relative to
/// the origin of the nodes, rounded outward. O(LSS).
void sweptBoxes(const LssTable& table, const ChainMotion& motion, const ChainNodes& nodes,
                double margin, SweptBoxes& boxes);

/// Pieces of a span: between neighbouring nodes.
inline constexpr int kNodePieces = kNodes - 1;
/// Boxes of the pieces of one LSS: lower[axis][piece]; the eighth lane is an empty box.
struct alignas(64) PieceBoxes {
  float lower[3][kNodes], upper[3][kNodes];
};
/// The float boxes of one LSS between neighbouring nodes, as sweptBoxes().
[[nodiscard]] PieceBoxes pieceBoxes(const LssTable::Entry& entry, const ChainMotion& motion,
                                    const ChainNodes& nodes, double margin);

}  // namespace foretouch
