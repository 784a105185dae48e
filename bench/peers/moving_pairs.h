// bench/peers/moving_pairs.h: two LSS that both move, as every solver solves them, and the truth.
// Metres in W; t in [0,1].
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/sweep_solver.h"

namespace foretouch::tools {

struct MovingPair {
  RigidSweep one, other;
  bool touches = false;  ///< In truth, as the next one.
  double toi = 1.0;      ///< Proven free before.
};

/// So long and so thick is each: about a forearm.
[[nodiscard]] Lss movingLss();

/// Pairs that begin at least a centimetre apart, about half of which meet: the same for the same
/// seed. The judge's certified answer is their truth.
[[nodiscard]] std::vector<MovingPair> drawnPairs(int count, std::uint64_t seed);

/// One solver with one setting, for two of movingLss(). Only solve() is timed.
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
