// judge/hull_oracle.h: the truth between two poses, for inputs at the limit of doubles: motion by
// its definition, distances in fifty digits, and a proof of freedom by spans of [0,1] in which no
// point crosses a plane.
//
// A span [m-h, m+h] is proven for a hull and a triangle if, for the unit normal n of their nearest
// points at m, every point e of the hull keeps
//   n.(e(m) - y) - radius - h |n.e'(m)| - h^2/2 A_e > 0   for all y of the triangle,
// with A_e a bound on |e''|. Tries spans in long double first, with a guard of
// kGuard * (depth + 4) of its roundoffs of the extents; repeats those within the guard, or without
// a proof, in fifty digits.
#pragma once

#include <cstdint>
#include <vector>

#include "judge/hull.h"
#include "judge/motion.h"

namespace foretouch::oracle {

/// Lengths are bounded by roots in float, which keep at least 1.1e-19 m per joint.
inline constexpr double kLeastExtent = 1e-16;

struct HullWorld {
  std::vector<Joint> joints;
  std::vector<Hull> hulls;
  std::vector<Triangle> triangles;
};

enum class Freedom : std::uint8_t {
  Proven,   ///< Separation > 0 on all of it.
  Touches,  ///< At `touchesAt`, which is in it, the separation is <= 0 to forty digits.
  Open,     ///< No proof of either within the budget.
};

struct FreedomProof {
  Freedom freedom = Freedom::Proven;
  double touchesAt = 1.0;
  /// The least separation (m) at the instants it looked at; infinity if none.
  double least = 0.0;
};

/// Whether `t` lies after the instant at which a fall from `high` to `low` (not above radius)
/// reaches `radius`: t (high - low) > high - radius, without rounding.
[[nodiscard]] bool isAfterFall(double t, double high, double low, double radius);

class HullOracle {
 public:
  explicit HullOracle(HullWorld world);

  /// Least separation (m) of the link's hulls and the scene at `t`; below zero: penetration of the
  /// radius. Infinite (1e300) for a link without hulls.
  [[nodiscard]] Precise separationAt(int link, double t) const;

  /// One per link: is it free on [0, until[link]]? 0: not requested.
  [[nodiscard]] std::vector<FreedomProof> proveFree(const std::vector<double>& until) const;

  /// Largest magnitude (m), at least kLeastExtent, in the link's separations: the scene's
  /// coordinates, and how far the link reaches from the world's origin and moves in the step,
  /// radius included.
  [[nodiscard]] double extent(int link) const { return extents_[static_cast<std::size_t>(link)]; }
  [[nodiscard]] int depth(int link) const { return quick_.bounds(link).depth; }

 private:
  friend class HullProver;
  void guard(const Hull& hull, const Motion& fromWorld, double scene, Real sceneFromOrigin);

  HullWorld world_;
  Vec3d origin_;
  Motion quick_;
  MotionOf<Precise> precise_;
  std::vector<Corners<Real>> quickTriangles_;
  std::vector<Corners<Precise>> preciseTriangles_;
  std::vector<double> extents_;
  std::vector<Real> guards_;  // one per hull
};

}  // namespace foretouch::oracle
