// judge/rigid_prover.h: a triangle of a body whose position and unnormalised quaternion are linear
// in t, against a triangle at rest: is the separation above a level throughout a span? By certified
// subdivision: double, long double, then thirty-four digits, each only for the spans that the one
// before cannot decide. Shares no code with the product.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "judge/vector.h"
#include "judge/wide.h"

namespace foretouch::oracle {

/// A point p of the body is at x + R(q) p, x = x0 + t (x1-x0), q = q0 + t (q1-q0); w, x, y, z.
struct RigidPair {
  Vec3d x0, x1;
  std::array<double, 4> q0{1, 0, 0, 0}, q1{1, 0, 0, 0};
  Triangle moving;  ///< In the body's frame.
  Triangle fixed;
};

struct RigidSpan {
  bool free = false;               ///< Separation > level - kRigidGuard * size proved throughout.
  std::optional<double> touching;  ///< Near an instant with separation <= level; then not free.
  Wide separation = 0;             ///< There.
  std::uint64_t grazing = 0;       ///< Spans shorter than kShortestRigidSpan, ignored.
  std::uint64_t looks = 0, wideLooks = 0;
};

/// Thirty-four digits lose less than this share of the size.
inline constexpr double kRigidGuard = 1e-30;
/// Such a span holds a separation within speed * 1e-27 of the level.
inline constexpr double kShortestRigidSpan = 0x1p-90;

/// `pair` must have |q(t)| > 0 throughout.
class RigidProver {
 public:
  explicit RigidProver(const RigidPair& pair);

  /// Proves the span free of separations up to `level`, both ends included, or finds one. Neither:
  /// it ran out of looks.
  [[nodiscard]] RigidSpan prove(double from, double to, double level);
  [[nodiscard]] Wide separationAt(double t) const;

  static constexpr std::uint64_t kMostLooks = 20'000, kMostWideLooks = 1'000;

 private:
  enum class Look { Free, Touching, TooLong, Doubtful };
  template <typename S>
  Look look(const Wide& from, const Wide& to, double level, double share);
  Look lookTwice(const Wide& from, const Wide& to, double level);
  bool proveSpan(const Wide& from, const Wide& to, double level);

  RigidPair pair_;
  double extent_ = 0;  ///< The extent of all that moves, from the fixed triangle's first vertex.
  RigidSpan outcome_;
};

}  // namespace foretouch::oracle
