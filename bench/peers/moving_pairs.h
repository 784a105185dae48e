// bench/peers/moving_pairs.h: two bodies that both move, as every solver solves them, and the
// truth: two LSS, or a ring of triangles and an LSS. Metres in W; t in [0,1].
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/sweep_solver.h"
#include "lss/lss.h"

namespace foretouch::tools {

enum class PairKind : std::uint8_t { Capsules, RingAndCapsule };

struct MovingPair {
  /// A ring is the first one; its lss_L is then a diameter of it, for its speed.
  RigidSweep one, other;
  bool touches = false;  ///< In truth, as the next one.
  double toi = 1.0;      ///< Proven free before.
};

/// Each is so long and so thick: about a forearm.
[[nodiscard]] Lss movingLss();
/// A torus about z, 24 cm across, of 384 triangles.
[[nodiscard]] const std::vector<Triangle>& movingRing();

/// Pairs that begin at least a centimetre apart, about half of which meet: the same seed gives the
/// same pairs. The judge's certified answer is their truth.
[[nodiscard]] std::vector<MovingPair> drawnPairs(PairKind kind, int count, std::uint64_t seed);

/// One solver with one setting, for pairs of one kind. Only solve() is timed.
class PairSolver {
 public:
  explicit PairSolver(std::string name) : name_(std::move(name)) {}
  PairSolver(const PairSolver&) = delete;
  PairSolver& operator=(const PairSolver&) = delete;
  virtual ~PairSolver() = default;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] virtual SweepAnswer solve(const MovingPair& pair) = 0;

 private:
  std::string name_;
};
using PairSolvers = std::vector<std::unique_ptr<PairSolver>>;

}  // namespace foretouch::tools
