#include "tests/reference/chain_piece.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lss/rounding.h"
#include "middleware/pair/link_query.h"
#include "tests/reference/rigid_plane.h"

namespace foretouch::internal {
namespace {

/// Of a quaternion drawn from a rotation matrix and of the products with it, per metre; thousands
/// of roundings, far above what either loses.
constexpr double kQuaternionRounding = 1e-13;
constexpr int kMostHalvings = 60;

/// Bound on |acceleration|, per squared span, of a point at distance 1 from the axis while the
/// quaternion goes straight from q0 to q1, unit, a chord apart: the angle's first derivative is at
/// most 2c/m and its second at most 2c^3/m^2, where m = 1 - c^2/4 <= |q|^2.
double turnAcceleration(double chord) {
  const double m = 1.0 - 0.25 * chord * chord;
  const double rate = 2.0 * chord / m;
  return rate * rate + 2.0 * chord * chord * chord / (m * m);
}

double farthestCorner(const Triangle& triangle) {
  double rho = 0.0;
  for (const Eigen::Vector3d& v : triangle.vertices) rho = std::max(rho, v.norm());
  return rho * kInflation;
}

}  // namespace

ChainPiece chainPiece(const LinkState& begin, const LinkState& end, double span,
                      const MotionBounds& bounds, double rho) {
  ChainPiece piece;
  piece.motion.x0 = begin.p_WL;
  piece.motion.x1 = end.p_WL;
  piece.motion.q0 = Quaternion(begin.R_WL);
  piece.motion.q1 = Quaternion(end.R_WL);
  piece.motion.q0.normalize();
  piece.motion.q1.normalize();
  if (piece.motion.q0.dot(piece.motion.q1) < 0.0) {
    piece.motion.q1.coeffs() = -piece.motion.q1.coeffs();
  }
  const double chord = (piece.motion.q1.coeffs() - piece.motion.q0.coeffs()).norm() + 1e-15;
  const double sagitta =
      (bounds.accelerationAt(rho) * span * span + rho * turnAcceleration(chord)) / 8.0;
  const double rounding =
      bounds.positionRoundingAt(rho) + kQuaternionRounding * rho + 1e-15 * bounds.reach;
  piece.deviation = (sagitta + rounding) * kInflation;
  return piece;
}

double freeUntilByCubics(MotionEvaluator& states, LinkId link, double t, double horizon,
                         const Triangle& part_L, const Triangle& fixed_W, double floor, double band,
                         const Eigen::Vector3d& nhat_W) {
  const double rho = farthestCorner(part_L);
  const MotionBounds& bounds = states.motion().bounds(link);
  const double turn = bounds.angularSpeed * bounds.angularSpeed * rho;
  const double wanted = std::sqrt(8.0 * band / (bounds.accelerationAt(rho) + turn + 1e-300));
  double end = std::min(horizon, t + 0.95 * wanted);
  const LinkState begin = states.stateAt(link, t);
  for (int i = 0; i < kMostHalvings && end > t; ++i, end = t + 0.5 * (end - t)) {
    // A turn of more than a right angle is not a short piece, whatever the band.
    const ChainPiece piece = chainPiece(begin, states.stateAt(link, end), end - t, bounds, rho);
    if (piece.deviation > band || piece.motion.q0.dot(piece.motion.q1) < 0.8) continue;
    const RigidAnswer answer =
        rigidTrianglePairFromPlane(piece.motion, part_L, fixed_W, floor + piece.deviation, nhat_W);
    if (!answer.leaf.hits) return end;
    const double until = t + (end - t) * answer.leaf.toiLow * (1.0 - 1e-12);
    return std::max(t, std::nextafter(until, 0.0));
  }
  return t;
}

double CubicsProver::freeUntil(const LinkQuery& query, const Candidate& candidate,
                               const MovingPair& pair, double t, QueryCounters& counters) const {
  ++counters.cubicTests;
  const double floor = kFloorShare * query.tolerance;
  return freeUntilByCubics(query.one.evaluator, query.one.link, t, 1.0,
                           query.one.surface->triangle(candidate.part.index()),
                           query.scene->triangle(candidate.triangle), floor, floor, pair.axes.nhat);
}

}  // namespace foretouch::internal
