// bench/extremes/extreme_case.h: one step, as a user would pass it in: unchecked. And the pieces
// from which families make such steps.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "articulated/skeleton.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"
#include "tools/portable_random.h"

namespace foretouch::tools::extremes {

/// A straight fall to the plane y = 0: the instant of touching is the ratio of two differences of
/// doubles, (high - radius) / (high - low).
struct Fall {
  double high = 0.0, low = 0.0, radius = 0.0;
};

struct ExtremeCase {
  std::string family, member;
  std::uint64_t seed = 0;
  RawSkeleton skeleton;
  std::vector<std::vector<Lss>> lss;  ///< Per link, in L.
  Pose from, to;
  RawScene scene;
  double tolerance = 1e-3;
  std::vector<std::vector<Triangle>> surface;  ///< Per link; empty: link fidelity alone.
  bool isLegal = true;                         ///< Otherwise the product must refuse it.
  std::optional<Fall> fall;  ///< The last link's, if it is a fall that ends at the plane or below.

  /// Adds to the scene, as object 0.
  void add(const Triangle& triangle);
};

/// Numbers of one case, from its seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return random_.uniform(low, high); }
  /// Log-uniform.
  double magnitude(double low, double high);
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  double pick(std::initializer_list<double> values);
  std::size_t below(std::size_t count);
  Eigen::Vector3d direction();
  Eigen::Vector3d inBox(double half) { return random_.inBox(half); }
  Quaternion rotation(double angle);  ///< About any axis.

 private:
  PortableRandom random_;
};

[[nodiscard]] Quaternion aboutAxis(const Eigen::Vector3d& unitAxis, double angle);

/// The shape of a chain of limbs.
struct RigShape {
  int joints = 2;
  double reach = 0.5;  ///< A limb's (m).
  double radius = 0.05;
  double turn = 0.8;                                 ///< A joint's in the step, at most (rad).
  double travel = 0.5;                               ///< The root's, at most (m).
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Where the root's paths begin.
};
/// A case with such a chain, one LSS per limb, and no scene yet.
[[nodiscard]] ExtremeCase rigged(Draw& draw, const RigShape& shape);

/// How triangles lie around the motion.
struct AimShape {
  int count = 6;
  double size = 0.3;                    ///< Edges (m).
  double gapLow = 1e-4, gapHigh = 0.2;  ///< From an LSS at some instant (m), log-uniform.
  double inside = 0.2;                  ///< Share of triangles pushed into it instead.
};
/// Adds triangles near some limb at some instant.
void aim(Draw& draw, ExtremeCase& extreme, const AimShape& shape);
/// The corner at which aim() puts such a triangle. Uses the poses unchecked.
[[nodiscard]] Eigen::Vector3d aimed(Draw& draw, const ExtremeCase& extreme, const AimShape& shape);

/// Gives every limb its own triangles, all inside its LSS; slivers if `thin`.
void cover(Draw& draw, ExtremeCase& extreme, bool thin);

/// One joint that goes from one place to another without turning, and one ball or rod on it.
[[nodiscard]] ExtremeCase sliding(const Lss& lss, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& to);
/// A triangle in the plane y = `height`, reaching `half` and more around the origin.
[[nodiscard]] Triangle floorAt(double height, double half = 50.0);

}  // namespace foretouch::tools::extremes
